#!/bin/sh
# Films whose scattered light is a mean over frames: the same bytes however
# they are split, and settings that say what is wrong with them.
. "$(dirname "$0")/lib"

# fog TEMPORAL VELOCITY: a ball of fog on its way.
fog()
{
    cat <<END
#version 3.7;
global_settings { integrator photon
    volume_photons { count 3000 field_spacing 0.2 $1 } }
camera { location <0, 0, -4> look_at 0 }
light_source { <10, 10, -10> rgb 3 }
sphere { <clock, 0, 0>, 1 hollow pigment { rgbt 1 }
    interior { media { scattering { 1, 2 } absorption 0.2
        $2 } } }
END
}

film='+W12 +H9 --spp 2 --backend cpu +KFF9'
fog 'temporal 5' >five.pov
fog 'temporal 3' >three.pov
fog 'temporal 1' >none.pov
fog '' >best.pov

all_same()
{
    for i in 1 2 3 4 5 6 7 8 9; do
        same "$1$i.png" "$2$i.png"
    done
}

new_case 'the filter has an effect, and the switch is stronger than the scene'
for name in five three none best; do
    brume $name.pov $film +O$name
    exits 0
done
cmp -s five5.png none5.png && complain '5 taps have no effect'
cmp -s five5.png three5.png && complain '5 taps are as 3'
cmp -s best5.png five5.png && complain 'adaptive is as 5 taps'
cmp -s best5.png none5.png && complain 'a film is not filtered'
brume none.pov $film --temporal adaptive +Oadaptive
all_same best adaptive
fog 'temporal { adaptive reach 8 }' >written.pov
brume written.pov $film +Oadaptive
all_same best adaptive
brume none.pov $film --temporal adaptive,2 +Oshort
cmp -s short5.png best5.png && complain 'the reach has no effect'
# Pictures do not tell what their scenes are called.
brume none.pov $film --temporal 5 +Oswitch
all_same five switch
brume none.pov $film --temporal 1,2,1 +Oweights
all_same three weights
brume five.pov $film --temporal 1 +Ooff
all_same none off
fog 'temporal { 2, 4, 8, 4, 2 }' >written.pov
brume written.pov $film +Owritten
all_same five written

new_case 'along a velocity'
fog '' 'velocity { x / 8 units per_frame }' >drift.pov
brume drift.pov $film +Odrift
exits 0
cmp -s drift5.png best5.png && complain 'the velocity has no effect'
fog '' 'velocity { x * 3 fps 24 }' >drift.pov
brume drift.pov $film +Oseconds
all_same drift seconds
for i in 1 2 3; do
    brume drift.pov $film +Opart --shard $i/3
    exits 0
done
all_same drift part
rm part*

new_case 'in parts'
for parts in 2 3 8; do
    rm -f part*
    for i in $(seq $parts); do
        brume five.pov $film +Opart --shard $i/$parts
        exits 0
    done
    all_same five part
done
for i in 1 2 3; do
    brume best.pov $film +Opart --shard $i/3
    exits 0
done
all_same best part
brume five.pov $film +Osub +SF4 +EF4
same sub4.png five4.png

new_case 'a picture depends on the frames around it'
rm five6.png
brume five.pov $film +Ofive --resume +V
exits 0
is "$(grep -c 'left out' said)" 8
all_same switch five

new_case 'killed, and taken up again'
for t in 10 4 7 2 9 5; do
    "$BRUME" five.pov $film +Okilled --resume >printed 2>said &
    pid=$!
    sleep "0.$(printf %02d $t)"
    kill -KILL $pid 2>/dev/null
    wait $pid 2>/dev/null
    for picture in killed?.png; do
        [ ! -e "$picture" ] || same "five${picture#killed}" "$picture"
    done
done
brume five.pov $film +Okilled --resume
exits 0
all_same five killed

new_case 'a still has no filter'
brume five.pov --explain
grep -q '^filter  *no' printed || complain 'a filter is planned'
brume five.pov --explain +KFF9
grep -q '^filter  *yes .*mean over' printed || complain 'no filter is planned'
grep -q ' 6 numbers once it is filtered' printed ||
    complain 'what cells hold then is not told'

new_case 'what is wrong is told'
cp "$ROOT/tests/data/kinds.vdb" .
fog '' 'velocity { vdb "kinds.vdb" "wind" }' >bad.pov
brume bad.pov --check
exits 5
says "has no grid named 'wind'"
fog '' 'velocity { vdb "kinds.vdb" "real" }' >bad.pov
brume bad.pov --check
exits 5
says 'a velocity is a grid of vectors'
fog '' 'velocity { }' >bad.pov
brume bad.pov --check
exits 1
says "'velocity' needs a vector or a file"
fog '' 'velocity { x vdb "kinds.vdb" }' >bad.pov
brume bad.pov --check
exits 1
says 'takes a vector or a file, and only one'
fog '' 'velocity { x units voxels }' >bad.pov
brume bad.pov --check
exits 1
says "'voxels' are those of a file"
fog 'temporal 4' >bad.pov
brume bad.pov --check
exits 1
says 'weights of 1, 3 and 5 frames are known'
fog 'temporal { 1, 2 }' >bad.pov
brume bad.pov --check
exits 1
says 'weights are of an odd number of frames'
fog 'temporal { 1, 0, 1 }' >bad.pov
brume bad.pov --check
exits 1
says "the frame's own weight is 0"
fog 'temporal { adaptive 1, 2, 1 }' >bad.pov
brume bad.pov --check
exits 1
says "'adaptive', which finds them"
fog 'temporal { 1, 2, 1 reach 4 }' >bad.pov
brume bad.pov --check
exits 1
says "'reach' is for 'adaptive'"
brume none.pov --temporal 7
exits 2
says 'neither 1, 3 or 5 frames, nor weights'
brume none.pov --temporal adaptive,9
exits 2
says 'not adaptive,REACH of 1 to 8'
brume best.pov $film --preset paper --temporal adaptive
exits 2
says 'temporal adaptive needs gather tally'
brume none.pov --temporal 1,2
exits 2
says 'is no odd number of weights'

end_cases
