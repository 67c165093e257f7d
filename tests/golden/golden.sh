#!/bin/bash
# Each scene here against its reference picture: independent runs must show
# the same but for noise. `tests/golden/golden.sh make NAME` renders the
# reference of a scene anew: only where the picture itself was wrong.
#
# A scene's first line says: // reference N spp, runs of M spp
set -eu
here=tests/golden
runs=12
brume=${BRUME:-build/brume}
compare=${B:-build}/tests/tools/compare

# spp NAME reference|runs: the number in the first line.
spp()
{
    sed -n "1s|.*$2[ of]* \([0-9]*\) spp.*|\1|p" "$here/$1.pov"
}

render()
{
    "$brume" "$here/$1.pov" +W64 +H48 --spp "$2" --seed "$3" +O"$4"
}

check()
{
    local name=$1 i pictures=()
    for ((i = 1; i <= runs; i++)); do
        pictures+=("$TMPDIR/$name$i.exr")
        render "$name" "$(spp "$name" runs)" "$i" "${pictures[-1]}" || return
    done
    "$compare" bias "$here/$name.exr" "$(spp "$name" reference)" \
        "$(spp "$name" runs)" "${pictures[@]}"
}

if [ "${1:-}" = make ]; then
    render "$2" "$(spp "$2" reference)" 0 "$here/$2.exr"
    exit
fi
bad=0
for scene in "$here"/*.pov; do
    name=$(basename "$scene" .pov)
    if check "$name"; then
        echo "ok - $name"
    else
        echo "not ok - $name"
        bad=1
    fi
done
exit $bad
