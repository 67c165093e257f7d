#!/bin/sh
# The 48 frames of t4-smoke with their filter, small: whole, in parts, killed
# twenty times and taken up again, the same bytes.
. "$(dirname "$0")/../cli/lib"
grids=$ROOT/${B:-build}/tests/bench/grids
[ -x "$grids" ] || { echo "no program '$grids'"; exit 77; }
"$grids" . t4-smoke >grids.txt
film="$ROOT/tests/bench/t4-smoke.ini +KFF48 +W32 +H24 --spp 1 --integrator
    photon --photons 2000 --field-spacing 0.05 +L."
cp "$ROOT"/tests/bench/t4-smoke.* "$ROOT"/tests/bench/bench.inc .
film=$(echo "$film" | sed "s,$ROOT/tests/bench/,,")
frames=$(seq -w 48)

all_same()
{
    for i in $frames; do
        same whole$i.png "$1$i.png"
    done
}

new_case 'the whole film'
brume $film +Owhole
exits 0
is "$(wc -l <whole.frames.jsonl)" 48

for parts in 2 3 8; do
    new_case "in $parts parts"
    rm -f part*
    for i in $(seq $parts); do
        brume $film +Opart --shard $i/$parts
        exits 0
    done
    all_same part
done

# How long the film takes tells when to kill it.
new_case 'killed twenty times'
start=$(date +%s%N)
brume $film +Otimed
took_ns=$(($(date +%s%N) - start))
kills=0 n=0
while [ $kills -lt 20 ] && [ $n -lt 60 ]; do
    n=$((n + 1))
    "$BRUME" $film +Okilled --resume >printed 2>said &
    pid=$!
    part=$((took_ns / 1000000 * (1 + n * 7 % 13) / 60))
    sleep "$(printf %d.%03d $((part / 1000)) $((part % 1000)))"
    kill -KILL $pid 2>/dev/null
    if wait $pid 2>/dev/null; then
        rm -f killed*
    else
        kills=$((kills + 1))
    fi
    for picture in killed??.png; do
        [ ! -e "$picture" ] || same "whole${picture#killed}" "$picture"
    done
done
is $kills 20
brume $film +Okilled --resume
exits 0
all_same killed

end_cases
