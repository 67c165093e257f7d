#!/bin/sh
# What is missing, broken or hostile: exit codes, messages, nothing left over.
. "$(dirname "$0")/lib"
write_scene s.pov

new_case 'a missing scene'
brume nope.pov
exits 5
says "can't find the scene 'nope.pov'"

new_case 'a folder as scene'
mkdir folder folder.pov
quick folder
exits 5
quick folder.pov
exits 5

new_case 'a folder that is not there'
quick s.pov +Onowhere/out.png
exits 5
says "nowhere/out.png"

new_case 'a folder as picture'
mkdir out.png
quick s.pov +Oout.png
exits 5
lacks out.png/*

new_case 'a full disk'
brume s.pov +W400 +H400 --spp 1 +FP +O/dev/full
exits 5
says 'No space left'
"$BRUME" s.pov +W400 +H400 --spp 1 +FP +O- >/dev/full 2>said
took $?
exits 5
quick s.pov --stats /dev/full
exits 5
"$BRUME" --help >/dev/full 2>said
took $?
exits 5

new_case 'a closed pipe'
{
    "$BRUME" s.pov +W400 +H400 --spp 1 +FP +O- 2>said
    echo $? >code
} | true
took "$(cat code)"
exits 5

new_case 'a picture larger than memory'
brume s.pov +W16777216 +H16777216 --spp 1
exits 6
brume s.pov +W2000 +H2000 --spp 1 --memory 10M
exits 6
brume s.pov +W99999999999
exits 2

new_case 'a GPU that is not there'
if "$BRUME" s.pov +W8 +H6 --spp 2 --backend cuda >/dev/null 2>&1; then
    : # there is one
else
    quick s.pov --backend cuda
    exits 7
fi

new_case 'errors of the scene have place, line and caret'
printf 'sphere { 0, 1 }\nsfere { 0, 1 }\n' >word.pov
brume word.pov
exits 1
says 'word.pov:2:1: error: '
says 'sfere { 0, 1 }'
says '^'
lacks word.png

new_case 'errors of the scene, of standard input and of an included file'
echo '#include "inner.inc"' >outer.pov
printf '\n#error "stop here"\n' >inner.inc
brume outer.pov
exits 1
says 'inner.inc:2:'
says 'outer.pov:1'
echo '#error "piped"' | "$BRUME" - >printed 2>said
took $?
exits 1
says 'piped'

new_case 'an included file that is missing'
echo '#include "missing.inc"' >missing.pov
brume missing.pov
exits 5
says 'missing.pov:1:'

new_case 'a loop without end meets a limit or a signal'
echo '#while (1) #end' >loop.pov
"$BRUME" loop.pov --check >printed 2>said &
pid=$!
wait_until_ready $pid
sleep 0.5
kill -TERM $pid
wait $pid
took $?
exits 3 75

new_case 'a program without its module for OpenVDB'
cat >cloud.pov <<END
box { 0, 1 hollow material { interior { media {
  density { density_file vdb "kinds.vdb" "real" } } } } }
END
cp "$ROOT/tests/data/kinds.vdb" .
brume cloud.pov --check
exits 0
mkdir alone
cp "$BRUME" alone
alone/brume cloud.pov --check >printed 2>said
took $?
exits 5
says 'cloud.pov:2:'
says "kinds.vdb': OpenVDB's module can't be loaded: brume_vdb.so: "

new_case 'any bytes as scene'
head -c 5000 /dev/urandom >bytes.pov
brume bytes.pov --check
exits 0 1 2 3 4 5 6
head -c 100000 /dev/zero | tr '\0' '{' >deep.pov
brume deep.pov --check
exits 0 1 2 3 4 5 6

new_case 'an empty scene is black'
: >empty.pov
quick empty.pov +Oempty.ppm
exits 0
is "$(ppm_pixel empty.ppm 8 6 4 3)" '0 0 0'

new_case 'no temporary file is left'
left=$(find . -name '*tmp*' -o -name '.*[A-Za-z]' ! -name '.' | head)
is "$left" ''

end_cases
