#!/bin/sh
# Where pictures go, in which format, and what is in them.
. "$(dirname "$0")/lib"
write_scene s.pov
compare=$ROOT/${B:-build}/tests/tools/compare

magic()
{
    head -c 4 "$1" | od -An -tx1 | tr -d ' '
}

new_case 'the name picks the format'
for name in a.png a.exr a.ppm A.PNG; do
    quick s.pov +O$name
    exits 0
    has $name
done
is "$(magic a.png)" 89504e47
is "$(magic A.PNG)" 89504e47
is "$(magic a.exr)" 762f3101
is "$(head -c 2 a.ppm)" P6

new_case '+F picks it first'
quick s.pov +Ob.png +FE
exits 0
is "$(magic b.png.exr)" 762f3101

new_case 'another extension is kept, and told'
quick s.pov -GD +Oc.jpg
exits 0
has c.jpg.png
says '.jpg pictures are not supported yet'

new_case '-F writes nothing'
quick s.pov -F +Onone
exits 0
lacks none.png

new_case 'a name that ends with / is a folder'
mkdir folder
quick s.pov +Ofolder/
exits 0
has folder/s.png

new_case '+O- prints the picture, and text goes to standard error'
quick s.pov +FP +O-
exits 0
says 'frame 0'
same printed a.ppm
quick s.pov +O-
is "$(magic printed)" 89504e47
quick s.pov +FE +O-
same printed a.exr

new_case 'a scene from standard input'
"$BRUME" - +W8 +H6 --spp 2 +Ofrom-stdin.ppm <s.pov >printed 2>said
took $?
exits 0
same from-stdin.ppm a.ppm
"$BRUME" +I- +FP +O- +W8 +H6 --spp 2 <s.pov >printed 2>said
same printed a.ppm

new_case 'a run gives the same bytes again, with one thread and with two'
quick s.pov +Oagain.exr
same a.exr again.exr
quick s.pov +Oagain.exr --threads 1
same a.exr again.exr
quick s.pov +Oagain.exr --threads 2
same a.exr again.exr
quick s.pov +Oother.exr --seed 1
cmp -s a.exr other.exr && complain 'the seed has no effect'

new_case 'the background is sRGB in a PPM'
is "$(ppm_pixel a.ppm 8 6 0 0)" '124 170 203'

new_case '16 bits, and bits between'
quick s.pov +FP16 +Odeep.ppm
is "$(sed -n '/^[0-9]*$/{p;q;}' deep.ppm)" 65535
quick s.pov Bits_Per_Color=12 +Odeep12.ppm
same deep.ppm deep12.ppm

new_case 'alpha: the background is left out'
quick s.pov +UA +Oalpha.exr
exits 0
if command -v exrheader >/dev/null; then
    exrheader alpha.exr >header
    grep -q '^ *A, 32-bit' header || complain 'no channel A'
    for text in 'opacity.G, 32-bit' 'Z, 32-bit' 'scene (type string): "s.pov"' \
        'samplesPerPixel (type string): "2"'; do
        grep -qF "$text" header || complain "the header lacks: $text"
    done
    exrheader a.exr | grep -q '^ *A, 32-bit' && complain 'A without +UA'
fi
[ ! -x "$compare" ] || is "$("$compare" mean alpha.exr 0 0 1 1)" 0

new_case 'what was there is replaced, or stays when rendering fails'
echo old >kept.png
quick s.pov +Okept.png --backend cuda --memory 1
is "$(cat kept.png)" old
quick s.pov +Okept.png
is "$(magic kept.png)" 89504e47
is "$(echo .*kept* kept.png?*)" '.*kept* kept.png?*'

end_cases
