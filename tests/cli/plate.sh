#!/bin/sh
# Plates: named by the scene or the command line, one for each frame of a film,
# and what is said of those that can't be taken.
. "$(dirname "$0")/lib"

compare=$ROOT/${B:-build}/tests/tools/compare

cat >fog.pov <<'END'
#version 3.7;
camera { location <0, 0, -4> look_at 0 angle 40 }
box { <-9, -9, -1>, <9, 9, 1> hollow pigment { rgbt 1 }
    interior { media { absorption 0.4 emission 0.3 } } }
END
cat >wall.pov <<'END'
#version 3.7;
camera { location <0, 0, -4> look_at 0 angle 40 }
plane { -z, -(frame_number + 1) / 3 pigment { rgb <1, 0.5, 0.25> }
    finish { ambient 1 diffuse 0 } }
END
size='+W16 +H12 --spp 4'

new_case 'a film of plates that this program wrote, by scene and by switch'
brume wall.pov $size +KFF3 +Oplate.exr
exits 0
brume fog.pov $size +KFF3 --plate 'plate%d.exr' +Oa.exr
exits 0
{
    cat fog.pov
    echo 'background { exr concat("plate", str(frame_number, 0, 0), ".exr") }'
} >named.pov
brume named.pov $size +KFF3 +Ob.exr
exits 0
for i in 1 2 3; do
    "$compare" same a$i.exr b$i.exr || complain "frame $i differs"
done
cmp -s a1.exr a2.exr && complain 'the frames have one plate'
brume fog.pov $size +Oc.exr --plate plate1.exr --plate-depth none
exits 0
cmp -s a1.exr c.exr && complain 'depths have no effect'

new_case 'a surface of the scene and its plate look alike behind media'
{
    cat wall.pov
    sed 1,2d fog.pov
} >both.pov
brume both.pov $size +KFF3 +Od.exr
exits 0
for i in 1 2 3; do
    "$compare" relrmse d$i.exr a$i.exr >printed 2>said
    took $?
    exits 0
    awk '{ exit !($NF < 1e-3) }' printed || complain "$(cat printed)"
done

new_case 'what is finished is not rendered again, unless its plate changes'
touch mark
brume fog.pov $size +KFF3 --plate 'plate%d.exr' +Oa.exr --resume
exits 0
[ -z "$(find . -name 'a?.exr' -newer mark)" ] || complain 'it is rendered again'
cp -p a2.exr old.exr
brume wall.pov $size +KFF3 +SF2 +EF2 +KI5 +Oplate.exr --seed 3
cp plate3.exr plate2.exr
brume fog.pov $size +KFF3 --plate 'plate%d.exr' +Oa.exr --resume
exits 0
cmp -s a2.exr old.exr && complain 'the old plate is still in the picture'
"$compare" same a3.exr b3.exr || complain 'another frame changed'

new_case 'the plan tells of it'
brume fog.pov $size --plate plate1.exr --explain
exits 0
grep -q '^composite *yes' printed || complain 'it does not run'
prints "plate of 16 x 12 pixels: 192 with a depth, 0 not opaque"
brume fog.pov $size --explain
grep -q '^composite *no' printed || complain 'it runs'

new_case 'files that are none, or do not fit'
brume fog.pov $size --plate none.exr
exits 5
says 'none.exr'
brume fog.pov +W16 +H10 --spp 1 --plate plate1.exr
exits 1
says 'the plate has 16 x 12 pixels, the picture 16 x 10'
head -c 300 plate1.exr >cut.exr
brume fog.pov $size --plate cut.exr
exits 5
says 'cut.exr'
brume fog.pov $size --plate plate1.exr --plate-layer View
exits 5
says "has no layer 'View'"
brume fog.pov $size --plate 'plate%s.exr'
exits 2
echo 'background { exr "cut.exr" }' >>fog.pov
brume fog.pov $size
exits 5
says 'fog.pov:5:18: error:'

end_cases
