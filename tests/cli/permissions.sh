#!/bin/sh
# What a scene may read and write: each way out of the permitted folders ends
# with exit code 4, and what is outside stays as it was.
. "$(dirname "$0")/lib"
mkdir scene out library secret more
echo '#debug "secret\n"' >secret/s.inc
echo '"secret"' >secret/s.txt
echo kept >secret/kept
echo '"lib"' >library/l.txt
echo '"own"' >scene/o.txt
base=$PWD

# Reads a scene of one line, in scene/, whose pictures go to out/.
try()
{
    echo "$1" >scene/t.pov
    shift
    brume scene/t.pov +Oout/p.png +Llibrary +W1 +H1 "$@"
}

denied()
{
    exits 4
    says 'is not allowed'
    says "--allow-$1"
    ! grep -q '^secret' said || complain 'it was read'
    [ "$(cat secret/kept)" = kept ] || complain 'it was written'
}

reading="#read (F, S) #debug concat(S, \"\n\")"

new_case 'a scene reads its own folder and the library path'
try "#fopen F \"o.txt\" read $reading #fopen F \"l.txt\" read $reading"
exits 0
says own
says lib

new_case 'no file elsewhere'
for name in ../secret/s.txt "$base/secret/s.txt" scene/../../secret/s.txt \
    ../scene/../secret/s.txt; do
    try "#fopen F \"$name\" read $reading"
    exits 4 5
done
try "#fopen F \"../secret/s.txt\" read $reading"
denied read
try "#fopen F \"$base/secret/s.txt\" read $reading"
denied read
try '#include "../secret/s.inc"'
denied read
try "#include \"$base/secret/s.inc\""
denied read

new_case 'no link that leads elsewhere'
ln -s ../secret/s.txt scene/link.txt
ln -s ../secret scene/folder
ln -s ../secret/s.inc scene/link.inc
try "#fopen F \"link.txt\" read $reading"
denied read
try "#fopen F \"folder/s.txt\" read $reading"
denied read
try '#include "link.inc"'
denied read
try '#include "link"'
denied read
try '#include "folder/s.inc"'
denied read

new_case 'unless the user allows it'
try "#fopen F \"../secret/s.txt\" read $reading" --allow-read secret
exits 0
says secret
try '#include "folder/s.inc"' --allow-read "$base/secret"
exits 0
try '#fopen F "s.txt" read' --allow-read=secret
exits 0

new_case 'nothing of a file that is denied is told'
try '#if (file_exists("../secret/s.txt")) #error "there" #end'
exits 0
try '#if (file_exists("../secret/none")) #error "there" #end'
exits 0

new_case 'a scene writes to the output folder'
try '#fopen F "w.txt" write #write (F, 1) #fclose F #include "w.txt"'
exits 0 1
is "$(cat out/w.txt)" 1
[ ! -e w.txt ] && [ ! -e scene/w.txt ] || complain 'it is elsewhere'
try "#fopen F \"$base/out/v.txt\" append #write (F, 2)"
exits 0
is "$(cat out/v.txt)" 2

new_case 'to the working folder where that is the output folder'
echo '#fopen F "x.txt" write #write (F, 3)' >scene/t.pov
brume scene/t.pov +Op.png +W1 +H1
exits 0
is "$(cat x.txt)" 3

new_case 'nowhere else'
for name in ../secret/kept "$base/secret/kept" ../secret/new \
    ../scene/../secret/kept "$base/out/../secret/kept" /tmp; do
    for mode in write append; do
        try "#fopen F \"$name\" $mode #write (F, 1)"
        exits 4 5
    done
done
try "#fopen F \"$base/secret/kept\" write"
denied write
try '#fopen F "../secret/kept" append'
denied write
[ ! -e secret/new ] || complain 'it was made'

new_case 'through no link'
ln -s ../secret/kept out/kept
ln -s ../secret out/folder
ln -s ../secret/made out/made
ln -s kept out/twice
for name in kept folder/kept twice; do
    try "#fopen F \"$name\" write #write (F, 1)"
    denied write
    try "#fopen F \"$name\" append #write (F, 1)"
    denied write
done
try '#fopen F "made" write #write (F, 1)'
exits 4 5
[ ! -e secret/made ] || complain 'it was made'

new_case 'through a link that stays inside'
echo old >out/real.txt
ln -s real.txt out/near.txt
try '#fopen F "near.txt" write #write (F, "new")'
exits 0
is "$(cat out/real.txt)" new

new_case 'no hidden file'
mkdir out/.hidden
for name in .bashrc .hidden/a "$base/out/.bashrc" sub/../.bashrc; do
    try "#fopen F \"$name\" write #write (F, 1)"
    exits 4 5
done
try '#fopen F ".bashrc" write'
denied write
[ ! -e out/.bashrc ] && [ ! -e out/.hidden/a ] || complain 'it was made'

new_case 'no device and no pipe'
mkfifo out/pipe
try '#fopen F "pipe" write #write (F, 1)'
exits 4 5
echo '#fopen F "null" write #write (F, 1)' >scene/t.pov
brume scene/t.pov +O/dev/null +W1 +H1
exits 4

new_case 'unless the user allows the folder'
try "#fopen F \"$base/more/a.txt\" write #write (F, 1)" --allow-write more
exits 0
is "$(cat more/a.txt)" 1

new_case 'a scene reads what it wrote, and nothing else there'
try "#fopen F \"w.txt\" write #write (F, \"\\\"mine\\\"\") #fclose F
#fopen F \"w.txt\" read $reading"
exits 0
says mine
echo '"other"' >out/other.txt
try "#fopen F \"w.txt\" write #fclose F #fopen F \"other.txt\" read $reading"
denied read

new_case 'the next frame reads it too'
cat >scene/t.pov <<'END'
#if (frame_number > 1)
    #fopen F "state.txt" read #read (F, N) #fclose F
#else
    #declare N = 0;
#end
#debug concat("N ", str(N, 0, 0), "\n")
#fopen F "state.txt" write #write (F, N + 10) #fclose F
END
brume scene/t.pov +Oout/p.png +KFF3 +W1 +H1
exits 0
says 'N 20'

end_cases
