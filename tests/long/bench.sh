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
    for k in ("few", "many", "paper", "rays", "path"):
        d = r[k]
        assert d["seconds"] > 0 and d["cpu"] > 0 and 0 < d["noise"] < 1 and abs(d["off"]) < 0.3
        assert abs(d["open"]) < 1e-5
    assert r["many"]["noise"] < r["few"]["noise"]
P

new_case 'what is measured is not measured again'
before=$(cat results/bench.json)
(cd "$ROOT" && BRUME=$BRUME tests/bench/bench.py --budget 4 --scale 0.05 \
    --samples 8 --out "$out" --resume t1-fog t4-smoke t2-flame3) >printed 2>said
took $?
exits 0
is "$(grep -c '"name"' printed)" 1
is "$("$json" results/bench.json results 1 name)" '"t2-flame3"'
is "$("$json" results/bench.json results 0 path seconds)" \
    "$(echo "$before" >before.json; "$json" before.json results 0 path seconds)"

new_case 'passes of progressive'
(cd "$ROOT" && tests/bench/progressive.py --program "$BRUME" --seconds 3 \
    --photons 50000 --passes 1,4 --out "$out/progressive.md" t1-fog) \
    >printed 2>said
took $?
exits 0
is "$(grep -c '^| t1-fog | [14] |' results/progressive.md)" 2
grep -q '^- t1-fog: down to [0-9.]* %, with the power -0\.[2-9]' \
    results/progressive.md || complain "$(cat results/progressive.md)"

end_cases
