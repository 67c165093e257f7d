#!/bin/sh
# --explain, --stats, --check, and the streams of text.
. "$(dirname "$0")/lib"
write_scene s.pov

json=$ROOT/${B:-build}/tests/tools/json

new_case '--explain prints each stage and its reason'
brume s.pov --explain +Ono.png
exits 0
prints 'because'
prints 'march'
lacks no.png

new_case '--explain=json is JSON'
brume s.pov --explain=json
exits 0
"$json" printed brume >value || complain 'it is not JSON'
prints '"reason"'

new_case '--explain of a film plans its first frame'
brume s.pov --explain +KFF5 +SF3
exits 0
is "$(grep -c frame said)" 1
says 'frame 3'

new_case '--check reads every frame and renders nothing'
brume s.pov --check +KFF3 +Ono.png
exits 0
is "$(grep -c frame said)" 3
lacks no1.png

new_case '--stats is JSON with every frame'
quick s.pov +KFF2 +Ofilm.png --stats stats.json
exits 0
"$json" stats.json exit_code >value || complain 'it is not JSON'
for key in spp error paths rays majorant_exceeded backend seconds picture; do
    is "$(grep -c "\"$key\"" stats.json)" 2
done

new_case 'a still tells nothing without a terminal, and with +V its line'
quick s.pov -GD
exits 0
is_silent
quick s.pov -GD +V
says 's.png: 2 samples a pixel'

new_case 'streams can be hidden and copied'
quick s.pov +GDdebug.txt +GAall.txt +V -GS
exits 0
is "$(cat debug.txt)" 'frame 0 clock 0.000 of 0'
says 'frame 0 clock 0.000 of 0'
grep -q 'samples a pixel' all.txt || complain 'all.txt lacks the statistics'
quick s.pov -GD Debug_File=debug.txt +GP
is_silent
is "$(grep -c frame debug.txt)" 2

new_case '-GA hides no error'
echo 'sphere {' >wrong.pov
brume wrong.pov -GA
exits 1
says 'error:'

end_cases
