#!/bin/sh
# make bench, on two scenes and small: its JSON and its page have what was
# measured, beside what was published.
. "$(dirname "$0")/../cli/lib"
command -v python3 >/dev/null || { echo 'no python3'; exit 77; }
json=$ROOT/${B:-build}/tests/tools/json

new_case 'two scenes are measured'
out=$PWD/results
(cd "$ROOT" && BRUME=$BRUME tests/bench/bench.py --budget 4 --scale 0.05 \
    --samples 8 --out "$out" t1-fog t4-smoke) >printed 2>said
took $?
exits 0
has results/bench.json results/README.md
has results/bench.svg

new_case 'JSON and page tell of both'
published=$("$json" results/bench.json results 1 published)
is "${published%%0*}" 4.45
is "$(grep -c '^| t' results/README.md)" 4
python3 - <<'P' || complain 'what is measured makes no sense'
import json
for r in json.load(open("results/bench.json"))["results"]:
    for k in ("few", "many", "paper", "path"):
        d = r[k]
        assert d["seconds"] > 0 and 0 < d["noise"] < 1 and abs(d["off"]) < 0.3
        assert abs(d["open"]) < 1e-5
    assert r["many"]["noise"] < r["few"]["noise"]
P

end_cases
