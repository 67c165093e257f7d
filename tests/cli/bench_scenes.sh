#!/bin/sh
# The nine scenes of the bench: their grids are the ones of the table, the
# table is within what was fixed for all, and the small ones have pictures.
. "$(dirname "$0")/lib"
grids=$ROOT/${B:-build}/tests/bench/grids
table=$ROOT/tests/bench/grids.txt
small='t1-cloud t1-fog t2-flame3 t2-campfire t2-explosion t1-cloud-knot
       t1-fog-knot'
[ -x "$grids" ] || { echo "no program '$grids'"; exit 77; }

# within NAME COLUMN LOW HIGH: a number of the table, the mean over frames.
within()
{
    awk -v name="$1" -v item="$2" -v low="$3" -v high="$4" '
        index($1, name) == 1 && !/triangles/ {
            for (i = 1; i < NF; i++)
                if ($i == item) { sum += $(i + 1); n++ }
        }
        END { exit !(n && sum / n >= low && sum / n <= high) }' "$table" ||
        complain "$2 of $1 is not between $3 and $4"
}

new_case 'the grids are those of the table'
# shellcheck disable=SC2086
"$grids" . $small >rows || complain 'grids failed'
while read -r row; do
    grep -qxF -e "$row" "$table" || complain "not in the table: $row"
done <rows
is "$(wc -l <rows)" 7

new_case 'the table keeps to what is fixed for all'
for name in t1-cloud t1-fog t2-flame1 t2-flame2 t2-flame3 t2-campfire \
    t3-flight t4-smoke; do
    within $name filled 20 35
done
within t2-explosion filled 40 60
within t1-cloud depth 49 51
within t1-fog depth 2.5 3.5
for name in t2-flame1 t2-flame2 t2-flame3 t2-campfire t2-explosion \
    t3-flight t4-smoke; do
    within $name depth 8 12
done
grep -q 't3-flight.* from *0 to 255 ' "$table" || complain 'the flight'
is "$(grep -c t4-smoke "$table")" 60
grep -q 'cloud-knot *3592 tri' "$table" || complain 'cloud knot'
grep -q 'fog-knot *66454 tri' "$table" || complain 'fog knot'

new_case 'their scenes render, and show something'
for name in t1-cloud t1-fog t2-flame3 t2-campfire t2-explosion; do
    quick "$ROOT/tests/bench/$name.pov" +L. +O$name.ppm +FP
    exits 0
    is_silent
    is "$(ppm_size $name.ppm)" '8 6'
    [ "$(tail -c 144 $name.ppm | tr -d '\000' | wc -c)" -gt 0 ] ||
        complain "$name is black"
done

end_cases
