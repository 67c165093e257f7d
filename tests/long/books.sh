#!/bin/sh
# What photons emit is what is absorbed, escapes and is dropped by name, to
# 1e-5, in the nine scenes of the bench and all golden ones, however light is
# kept. GRIDS is a folder with the bench's grids, if they are made already.
. "$(dirname "$0")/../cli/lib"
grids=$ROOT/${B:-build}/tests/bench/grids
json=$ROOT/${B:-build}/tests/tools/json
[ -x "$grids" ] || { echo "no program '$grids'"; exit 77; }
[ -x "$json" ] || { echo "no program '$json'"; exit 77; }

entry()
{
    "$json" stats frames 0 photons "$@"
}

# Of the power emitted, what the entries leave over, and what the program says
# that they do.
left_over()
{
    for name in units media surfaces walls escaped roulette dropped rest; do
        entry books "$name"
    done | awk '{ of[NR] = $1 }
        END { print 1 + of[1] - of[2] - of[3] - of[4] - of[5] - of[6] - of[7]
              print of[8] }'
}

# $1 file, $2 photons that there must be at least
close_all()
{
    for way in photon 'photon --preset paper' progressive; do
        # shellcheck disable=SC2086
        quick "$1" +L"$GRIDS" --backend cpu --integrator $way \
            --photons 20000 --stats stats +Oout.exr
        exits 0
        photons=$(entry traced 2>entries || echo 0)
        [ "$photons" -ge "$2" ] || complain "$way: $photons photons"
        [ "$photons" -gt 0 ] || continue
        left_over >left
        awk -v way="$way" '!($1 < 1e-5 && $1 > -1e-5) {
            printf "%s: %g of the power is left over\n", way, $1 }' left >wrong
        [ ! -s wrong ] || complain "$(cat wrong)"
    done
}

if [ -z "${GRIDS:-}" ]; then
    new_case 'grids'
    GRIDS=$PWD
    "$grids" . >rows || complain 'grids failed'
fi
for name in t1-cloud t1-fog t2-flame1 t2-flame2 t2-flame3 t2-campfire \
    t2-explosion t3-flight t4-smoke; do
    new_case "the books of $name close"
    close_all "$ROOT/tests/bench/$name.pov" 20000
done
for file in "$ROOT"/tests/golden/*.pov; do
    new_case "the books of $(basename "$file") close"
    close_all "$file" 0
done
end_cases
