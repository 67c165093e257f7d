#!/bin/sh
# make bench, on two scenes and small: its JSON and its page have what was
# measured, beside what was published.
. "$(dirname "$0")/../cli/lib"
command -v python3 >/dev/null || { echo 'no python3'; exit 77; }
json=$ROOT/${B:-build}/tests/tools/json

new_case 'two scenes are measured'
out=$PWD/results
(cd "$ROOT" && BRUME=$BRUME tests/bench/bench.py --budget 2 --scale 0.05 \
    --out "$out" t1-fog t4-smoke) >printed 2>said
took $?
exits 0
has results/bench.json results/README.md
for name in t1-fog t4-smoke; do
    has results/$name.csv results/$name.svg
done

new_case 'JSON and page tell of both'
published=$("$json" results/bench.json results 1 published_seconds)
is "${published%%0*}" 4.45
is "$(grep -c '^| \[t' results/README.md)" 2
grep -q 'path spp' results/README.md || complain 'no switches'
python3 -c 'import json; json.load(open("results/bench.json"))' ||
    complain 'no JSON'

end_cases
