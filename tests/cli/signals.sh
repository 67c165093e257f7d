#!/bin/sh
# Signals end a run with 75 and leave whole pictures only.
. "$(dirname "$0")/lib"
write_scene s.pov

new_case 'SIGINT in the middle of a picture'
"$BRUME" s.pov +W800 +H600 --spp 60000 +Olong.png >printed 2>said &
pid=$!
wait_for 'frame 0' said
sleep 0.3
kill -INT $pid
wait $pid
took $?
exits 75
says 'stopped'
lacks long.png

new_case 'SIGTERM in the middle of a film'
"$BRUME" s.pov +W160 +H120 --spp 8 +KFF1000 +Ofilm.png --stats stats.json \
    >printed 2>said &
pid=$!
wait_for 'frame 4' said
kill -TERM $pid
wait $pid
took $?
exits 75
has film0001.png film0002.png
count=$(ls film*.png | wc -l)
[ "$count" -lt 1000 ] || complain 'it went on to the end'
grep -q '"exit_code": 75' stats.json || complain 'stats tell of no signal'
is "$(grep -c '"picture"' stats.json)" "$count"

new_case 'SIGTERM while it waits for standard input'
mkfifo pipe
"$BRUME" - <pipe >printed 2>said &
pid=$!
exec 9>pipe
wait_until_ready $pid
sleep 0.3
kill -TERM $pid
wait $pid
took $?
exec 9>&-
exits 75

# Sums of samples are kept, and go on.
new_case 'a picture that was stopped goes on to the same bytes'
cat >fog.pov <<'END'
camera { location <0, 0, -4> look_at 0 }
light_source { <9, 9, -9> rgb 2 }
sphere {
    0, 1
    hollow pigment { rgbt 1 }
    interior { media { scattering { 1, rgb 2 } absorption 0.3 } }
}
END
stops=0
for integrator in path photon progressive; do
    long="fog.pov +W48 +H36 --spp 700 --photons 20000 --transport full"
    [ $integrator != progressive ] || long="$long --spp 24 --photons 5000"
    long="$long --integrator $integrator +V"
    brume $long +Owhole.exr
    for pause in 0.2 0.4; do
        [ ! -e part.exr ] || break
        "$BRUME" $long +Opart.exr --resume >printed 2>said &
        pid=$!
        sleep $pause
        kill -TERM $pid 2>/dev/null
        wait $pid
        code=$?
        took $code
        exits 0 75
        [ $code = 0 ] || stops=$((stops + 1))
    done
    brume $long +Opart.exr --resume
    exits 0
    same whole.exr part.exr
    lacks part.exr.part
    rm part.exr
done
[ $stops -gt 0 ] || complain 'it was never stopped'

new_case 'and not from what is kept of another'
"$BRUME" s.pov +W60 +H45 --spp 60000 +Opart.exr >printed 2>said &
pid=$!
wait_until_ready $pid
sleep 1
kill -TERM $pid
wait $pid
has part.exr.part
cp part.exr.part kept
brume s.pov +W60 +H45 --spp 8 +Oeight.exr
brume s.pov +W60 +H45 --spp 8 +Opart.exr --resume
same eight.exr part.exr
lacks part.exr.part
rm part.exr
head -c 3000 kept >part.exr.part
brume s.pov +W60 +H45 --spp 8 +Opart.exr --resume
same eight.exr part.exr

new_case 'what a killed program left is swept away'
for file in .brume-1-0.tmp .brume-77-3.tmp .brume-1-0.tmp.mine brume-1-0.tmp; do
    echo left >$file
done
(
    flock -x 9
    brume s.pov +W8 +H6 --spp 1 +Osome.png
) 9>>.brume-77-3.tmp
lacks .brume-1-0.tmp
has .brume-77-3.tmp .brume-1-0.tmp.mine brume-1-0.tmp

end_cases
