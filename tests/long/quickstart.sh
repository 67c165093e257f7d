#!/bin/bash
# The README's picture at full size: its error, and its time on two cores.
. "$(dirname "$0")/../cli/lib"
compare=$ROOT/${B:-build}/tests/tools/compare
[ "$B" = build ] || { echo 'only for the plain build'; exit 77; }

# By the processor's time, since other tests may run beside this one.
new_case 'one minute on two cores'
TIMEFORMAT='%U %S'
{ time brume "$ROOT/scenes/quickstart.pov" +W640 +H480 +Oa.exr; } 2>cost
exits 0
awk '{ exit !(($1 + $2) / 2 < 60) }' cost || complain "took $(cat cost) s"

# Two pictures of equal error differ by the root of two times that.
new_case 'a relative error of at most 10 %'
brume "$ROOT/scenes/quickstart.pov" +W640 +H480 --seed 2 +Ob.exr
exits 0
error=$("$compare" relrmse a.exr b.exr | awk '{ print $1 / sqrt(2) }')
awk -v error="$error" 'BEGIN { exit !(error <= 0.1) }' ||
    complain "the error is $error"

end_cases
