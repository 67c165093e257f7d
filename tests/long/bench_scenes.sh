#!/bin/sh
# All grids of the bench's scenes, and the scenes of the largest of them.
. "$(dirname "$0")/../cli/lib"
grids=$ROOT/${B:-build}/tests/bench/grids
[ -x "$grids" ] || { echo "no program '$grids'"; exit 77; }

new_case 'all grids are those of the table'
"$grids" . >rows || complain 'grids failed'
same rows "$ROOT/tests/bench/grids.txt"

new_case 'the scenes of the largest render'
for name in t2-flame1 t2-flame2 t3-flight t4-smoke; do
    quick "$ROOT/tests/bench/$name.pov" +L. +O$name.ppm +FP
    exits 0
    is_silent
    [ "$(ppm_pixel $name.ppm 8 6 3 3)" != '0 0 0' ] ||
        complain "$name is black in its middle"
done

new_case 'a frame of the films'
for name in t3-flight t4-smoke; do
    quick "$ROOT/tests/bench/$name.ini" +L. +SF7 +EF7 +Ofilm.ppm +FP
    exits 0
    is_silent
done

end_cases
