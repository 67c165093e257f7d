#!/bin/sh
# The scene of the README, small: what is promised of every picture, and that
# its fire lights the ground.
. "$(dirname "$0")/lib"
scene=$ROOT/scenes/quickstart.pov
compare=$ROOT/${B:-build}/tests/tools/compare

# render FILE WORD...
render()
{
    file=$1
    shift
    brume "$scene" +W96 +H72 --spp 8 +O"$file" "$@"
    exits 0
}

# ground FILE: mean radiance of the ground before the fire.
ground()
{
    "$compare" mean "$1" 0 60 96 72
}

new_case 'a second run gives the same bytes'
render a.exr
render b.exr
same a.exr b.exr

new_case 'the pixels do not depend on the threads'
for threads in 1 2 3; do
    render threads.exr --threads $threads
    "$compare" same a.exr threads.exr || complain "$threads threads"
done

new_case 'another seed gives other noise'
render seed.exr --seed 5
! "$compare" same a.exr seed.exr || complain 'the same pixels'

new_case 'the fire lights the ground'
sed 's/intensity 6$/intensity 0/' "$scene" >dark.pov
! cmp -s "$scene" dark.pov || complain 'intensity is not where it was'
scene=dark.pov
render dark.exr +L"$ROOT/scenes"
ratio=$(echo "$(ground a.exr) $(ground dark.exr)" | awk '{ print $1 / $2 }')
awk -v ratio="$ratio" 'BEGIN { exit !(ratio >= 1.3) }' ||
    complain "only $ratio times as bright"

new_case 'other programs read the picture'
if command -v exrheader >/dev/null; then
    exrheader a.exr >header
    grep -q 'dataWindow.*(95 71)' header || complain "$(cat header)"
else
    current="$current # SKIP exrheader is not installed"
fi

new_case 'the film has eight different pictures'
brume "$ROOT/scenes/campfire.ini" +W32 +H24 --spp 1 +Ofilm.png
exits 0
is "$(md5sum film[1-8].png | cut -c 1-32 | sort -u | wc -l)" 8

end_cases
