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

end_cases
