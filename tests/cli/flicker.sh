#!/bin/sh
# brume measure --temporal: the filters of an animation by what they do.
. "$(dirname "$0")/lib"

cat >still.pov <<'END'
#version 3.7;
global_settings { integrator photon volume_photons { count 1000
    field_spacing 0.2 } }
camera { location <0, 0, -4> look_at 0 }
light_source { <10, 10, -10> rgb 3 }
sphere { 0, 1 hollow pigment { rgbt 1 }
    interior { media { scattering { 1, 8 } absorption 0.1 } } }
END

# column NAME ROW: of the CSV, rows by the filter's name.
column()
{
    awk -F, -v name="$1" -v row="\"$2\"" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i }
        $2 == row && $1 == photons { print $c }' "photons=${3-1000}" \
        still.flicker.csv
}

# less A B
less()
{
    awk "BEGIN { exit !($1 < $2) }" || complain "$1 is not less than $2"
}

new_case 'a scene that stands still'
brume measure --temporal still.pov +W12 +H12 --spp 4 +KFF8 --backend cpu
exits 0
prints '8 frames, 4 samples a pixel'
has still.flicker.csv
is "$(wc -l <still.flicker.csv)" 5
less "$(column flicker 3)" "$(column flicker 1)"
less "$(column flicker adaptive)" "$(column flicker 3)"
less "$(column difference 5)" "$(column difference 1)"
less 0.9 "$(column detail adaptive)"
less "$(column detail adaptive)" 1.1
is "$(column ring_bytes 1)" 0
less "$(column ring_bytes 3)" "$(column ring_bytes 5)"
lacks still1.png still.frames.jsonl

new_case 'several numbers of photons, and a velocity'
sed 's/absorption 0.1/& velocity { x }/' still.pov >moved.pov
mv moved.pov still.pov
brume measure --temporal still.pov +W12 +H12 --spp 64 +KFF4 --backend cpu \
    --photons 300,4000
exits 0
is "$(wc -l <still.flicker.csv)" 11
prints 'in place'
less "$(column flicker 1 4000)" "$(column flicker 1 300)"
less "$(column error adaptive 4000)" "$(column error adaptive 300)"

new_case 'repeated, with noise of its own each time'
brume measure --temporal still.pov +W12 +H12 --spp 4 +KFF4 --backend cpu \
    --photons 300,1000 --repeat 4
exits 0
is "$(column repeats adaptive 300)" 4
is "$(column repeats adaptive 1000)" 1
is "$(column lost_detail 1 300)" 0
is "$(column lost_detail_error adaptive 1000)" nan
less 0 "$(column lost_detail_error adaptive 300)"
less "$(column lost_detail_error adaptive 300)" 1
prints '+-'
four=$(column detail 1 300)
brume measure --temporal still.pov +W12 +H12 --spp 4 +KFF4 --backend cpu \
    --photons 300,1000
exits 0
is "$(column repeats adaptive 300)" 1
[ "$(column detail 1 300)" != "$four" ] || complain 'the noise was the same'

new_case 'one filter alone'
brume measure --temporal still.pov +W12 +H12 --spp 4 +KFF4 --backend cpu \
    --temporal 5
exits 0
is "$(wc -l <still.flicker.csv)" 3
less "$(column flicker 5)" "$(column flicker 1)"
brume measure --temporal still.pov +KFF4 --temporal 1,3,1
exits 2
says 'measures 1, 3, 5 and adaptive'

new_case 'what it cannot do'
brume still.pov --repeat 3
exits 2
says "--repeat is for 'brume measure --temporal'"
brume still.pov --photons 5,6
exits 2
says "several --photons are for 'brume measure --temporal'"
brume measure --temporal still.pov +KFF4 --photons 5,0
exits 2
says 'nor up to 8 of them'
brume measure --temporal still.pov
exits 2
says 'needs an animation'
brume measure --temporal still.pov +KFF4 --error 0.1
exits 2
says 'tries --spp, --error and --time itself'
brume measure --temporal still.pov +KFF4 --reference x.exr
exits 2
says "are for 'brume measure'"

end_cases
