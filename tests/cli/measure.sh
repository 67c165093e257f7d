#!/bin/sh
# brume measure: against a picture known in closed form, and by itself.
. "$(dirname "$0")/lib"

# A slab that scatters once, lit from the eye: (1 - exp(-2 tau)) / 2.
cat >slab.pov <<'END1'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -3> direction z up y right x }
light_source { <0, 0, -1000> rgb 1 parallel point_at 0 }
box { <-9, -9, 0>, <9, 9, 1>
    hollow pigment { rgbt 1 }
    interior { media { scattering { 1, rgb 1 } } } }
END1
cat >truth.pov <<'END1'
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb (1 - exp(-2)) / 2 }
END1

measure()
{
    brume measure "$@" +W32 +H24
}

# column NAME: a column of slab.csv, below its head.
column()
{
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++)
        if ($i == name) at = i } NR > 1 { print $at }' slab.csv
}

# Samples of a pixel are spread evenly: it falls faster.
new_case 'the error against the truth falls as 1 / sqrt(spp) or faster'
brume truth.pov +W32 +H24 +Otruth.exr
measure slab.pov --reference truth.exr --budget 4
exits 0
is_silent
prints 'its own noise: 0 %'
has slab.csv slab.svg
lacks slab-reference.exr
column spp >spp
column error >errors
paste spp errors | awk '{ k[NR] = $2 * sqrt($1) }
    END { for (i = 1; i <= NR; i++) if (k[i] > 1.15 * k[1]) {
        print "row", i, "of", NR; bad = 1 }
        exit bad || NR < 5 || k[NR] < k[1] / 1000 }' >told || complain "$(cat told)"

new_case 'the CSV has 13 columns, each sample count twice the one before'
awk -F, 'NF != 13 { exit 1 }' slab.csv || complain 'not 13 columns'
awk 'NR > 1 && $1 != 2 * before { exit 1 } { before = $1 }' spp ||
    complain "$(cat spp)"
is "$(column reference_noise | sort -u)" 0

new_case 'the advice is the quickest row that is good enough'
advised=$(sed -n 's/^for 10 %: .*--spp \([0-9]*\) .*/\1/p' printed)
column seconds | paste spp errors - | awk -v spp="$advised" '
    $2 <= 0.1 && (!found || $3 < least) { least = $3; best = $1; found = 1 }
    END { exit !(best == spp) }' || complain "for 10 %: $advised"
grep -q '^for  1 %.*extrapolated' printed || [ "$(tail -n 1 errors |
    awk '{ print ($1 <= 0.01) }')" = 1 ] || complain 'no advice for 1 %'

new_case 'the plot is XML'
if command -v xmllint >/dev/null; then
    xmllint --noout slab.svg 2>told || complain "$(cat told)"
fi
grep -q '<circle' slab.svg || complain 'there are no points'

new_case 'it makes a reference, tells its noise, and can take it again'
measure slab.pov --budget 1 +Oown.png
exits 0
has own.csv own.svg own-reference.exr
noise=$(sed -n 's/.*its own noise: //p' printed)
[ -n "$noise" ] || complain 'no noise is told'
measure slab.pov --budget 0.3 --reference own-reference.exr +Oagain
exits 0
prints "its own noise: $noise"

new_case 'a picture of unknown origin counts as exact, and that is told'
sed 's/relativeError/relativeOther/' truth.exr >plain.exr
measure slab.pov --budget 0.3 --reference plain.exr
prints 'its noise is not known'

new_case 'there is a row however short the time'
measure slab.pov --budget 0.001 +Oshort
exits 0
[ "$(wc -l <short.csv)" -ge 2 ] || complain 'no row'

new_case 'the first frame of a film is measured'
measure slab.pov --budget 0.2 +KFF3 -F
exits 0
is "$(grep -c reference: printed)" 1

new_case 'what makes no sense is an error of usage'
measure slab.pov --spp 4
exits 2
says 'tries --spp'
measure
exits 2
measure slab.pov --budget -1
exits 2
measure slab.pov +O-
exits 2
brume measure slab.pov --reference truth.exr +W20 +H24
exits 2
says '32 x 24'
brume slab.pov --budget 3
exits 2
says 'brume measure'

new_case 'files that are not there, or no pictures'
measure slab.pov --reference absent.exr
exits 5
measure slab.pov --reference slab.pov
exits 5
measure absent.pov
exits 5

new_case 'an error of the scene is one as ever'
echo 'sphere { }' >bad.pov
measure bad.pov
exits 1
lacks bad.csv bad.svg

new_case 'SIGINT ends it with 75 and leaves the rows that there are'
rm -f slab.csv slab.svg
"$BRUME" measure slab.pov --reference truth.exr --budget 100 +W32 +H24 \
    >printed 2>said &
pid=$!
for _ in $(seq 100); do
    [ ! -s slab.csv ] || break
    sleep 0.1
done
kill -INT $pid
wait $pid
took $?
exits 75
has slab.csv
lacks slab.svg

end_cases
