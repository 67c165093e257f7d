#!/bin/sh
# Reading and writing hide behind rendering also where each frame has a grid of
# its own and a mesh of 1 M triangles: rendering is 90 % of the film's time.
. "$(dirname "$0")/../cli/lib"
command -v python3 >/dev/null || { echo 'no python3'; exit 77; }
awk -v n=707 '
    function at(i, j) {
        return sprintf("<%.4f,%.4f,%.4f>", 4 * i / n - 2,
                       sin(i * j * 0.001) / 9, 4 * j / n - 2)
    }
    BEGIN {
        printf "#declare Ground = mesh2 { vertex_vectors { %d\n", (n + 1) ^ 2
        for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) print "," at(i, j)
        printf "} face_indices { %d\n", 2 * n * n
        for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
            a = i * (n + 1) + j
            printf ",<%d,%d,%d>,<%d,%d,%d>\n", a, a + 1, a + n + 2, a,
                   a + n + 2, a + n + 1
        }
        print "} }"
    }' >ground.inc
cp -r "$ROOT/scenes/campfire" "$ROOT/scenes/campfire.ini" .
cp "$ROOT/scenes/quickstart.pov" .
cat >>quickstart.pov <<'END'
#include "ground.inc"
object { Ground translate -3*y pigment { rgb 0.3 + 0.1*clock } }
END
new_case 'rendering is 90 % of the time of a film'
python3 "$ROOT/tests/bench/overlap.py" "$BRUME" campfire.ini +W160 +H120 \
    --photons 200000 --spp 16 >printed 2>said
took $?
exits 0
part=$(sed -n 's/.*, \([0-9]*\)\.[0-9]* %.*/\1/p' printed)
echo "# $(cat printed)"
[ "${part:-0}" -ge 90 ] || complain "rendering is $part %"

end_cases
