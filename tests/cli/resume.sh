#!/bin/sh
# Films that are split, stopped, killed and taken up again have the bytes of
# those that were not.
. "$(dirname "$0")/lib"
write_scene s.pov
film='+W24 +H18 --spp 4 +KFF9'

# parts FILE...: all nine pictures are those of the whole film.
all_same()
{
    for i in 1 2 3 4 5 6 7 8 9; do
        same "whole$i.png" "$1$i.png"
    done
}

# lines FILE: of the manifest.
lines()
{
    wc -l <"$1" | tr -d ' '
}

new_case 'the whole film'
brume s.pov $film +Owhole
exits 0
is "$(lines whole.frames.jsonl)" 9
cmp -s whole1.png whole2.png && complain 'nothing moves'
grep -q '"picture":"whole9.png"' whole.frames.jsonl || complain 'no line of 9'
grep -q '"s.pov":"[0-9a-f]\{16\}"' whole.frames.jsonl || complain 'no file'

for parts in 2 3 8 20; do
    new_case "in $parts parts"
    rm -f part*
    for i in $(seq $parts); do
        brume s.pov $film +Opart --shard $i/$parts
        exits 0
    done
    all_same part
    is "$(lines part.frames.jsonl)" 9
done

new_case 'tasks of a job array'
rm -f array*
export SLURM_ARRAY_TASK_MIN=10 SLURM_ARRAY_TASK_MAX=16 \
    SLURM_ARRAY_TASK_STEP=3 SLURM_ARRAY_TASK_COUNT=3
for id in 10 13 16; do
    SLURM_ARRAY_TASK_ID=$id brume s.pov $film +Oarray --shard slurm
    exits 0
done
all_same array
is "$(lines array.frames.jsonl)" 9
# As --array=1,2,7 makes it.
SLURM_ARRAY_TASK_ID=10 SLURM_ARRAY_TASK_COUNT=2 brume s.pov $film --shard slurm
exits 2
says 'has gaps'

new_case 'each with a step of two tasks'
rm -f step*
for id in 10 13 16; do
    for rank in 0 1; do
        SLURM_ARRAY_TASK_ID=$id SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=$rank \
            brume s.pov $film +Ostep --shard slurm
        exits 0
    done
done
all_same step
is "$(lines step.frames.jsonl)" 9

new_case 'never by itself'
SLURM_ARRAY_TASK_ID=10 brume s.pov $film +Oself
exits 0
all_same self
unset SLURM_ARRAY_TASK_MIN SLURM_ARRAY_TASK_MAX SLURM_ARRAY_TASK_STEP \
    SLURM_ARRAY_TASK_COUNT
brume s.pov $film --shard slurm
exits 2
says 'neither a task of a job array'

new_case 'what is finished is left out'
rm whole4.png
brume s.pov $film +Owhole --resume +V
exits 0
is "$(grep -c 'left out' said)" 8
has whole4.png
brume s.pov $film +Owhole +C +V
is "$(grep -c 'left out' said)" 9
brume s.pov $film +Owhole +V
is "$(grep -c 'left out' said)" 0

new_case 'and what would differ is not'
cp whole4.png kept.png
brume s.pov $film +Owhole +C +V Declare=Any=1
is "$(grep -c 'left out' said)" 0
brume s.pov $film +Owhole
echo x >>whole2.png
brume s.pov $film +Owhole +C +V
is "$(grep -c 'left out' said)" 8
echo '// changed' >>s.pov
brume s.pov $film +Owhole +C +V
is "$(grep -c 'left out' said)" 0
same whole4.png kept.png

new_case 'files that the scene looked for in vain'
cat >inc.pov <<'END'
#if (file_exists("more.inc")) #include "more.inc" #end
sphere { 0, 1 }
END
brume inc.pov +W4 +H4 --spp 1 +KFF2 +Oinc
brume inc.pov +W4 +H4 --spp 1 +KFF2 +Oinc +C +V
is "$(grep -c 'left out' said)" 2
echo 'sphere { 2, 1 }' >more.inc
brume inc.pov +W4 +H4 --spp 1 +KFF2 +Oinc +C +V
is "$(grep -c 'left out' said)" 0
brume inc.pov +W4 +H4 --spp 1 +KFF2 +Oinc +C +V
is "$(grep -c 'left out' said)" 2
echo 'sphere { 3, 1 }' >more.inc
brume inc.pov +W4 +H4 --spp 1 +KFF2 +Oinc +C +V
is "$(grep -c 'left out' said)" 0

new_case 'a scene that writes files is read all the same'
cat >writes.pov <<'END'
#if (frame_number = 1)
    #fopen F "state.txt" write
    #write (F, "1,")
#else
    #fopen F "state.txt" append
    #write (F, frame_number, ",")
#end
#fclose F
#debug concat("read ", str(frame_number, 0, 0), "\n")
END
brume writes.pov +W4 +H4 --spp 1 +KFF3 +Owrites
rm writes3.png state.txt
brume writes.pov +W4 +H4 --spp 1 +KFF3 +Owrites +C
exits 0
is "$(cat state.txt)" '1,2,3,'
has writes3.png

new_case 'a scene that changes while it is rendered'
cp s.pov moves.pov
"$BRUME" moves.pov +W160 +H120 --spp 64 +KFF9 +Ochanged >printed 2>said &
pid=$!
wait_for '"frame":2' changed.frames.jsonl
sed 's/look_at 0/look_at 0.1*x/' s.pov >new.pov
cmp -s s.pov new.pov && complain 'nothing changed'
mv new.pov moves.pov
wait $pid
took $?
exits 0
says "'moves.pov' has changed since 'changed"
brume moves.pov +W160 +H120 --spp 64 +KFF9 +Ochanged +C +V
exits 0
says 'left out'
brume moves.pov +W160 +H120 --spp 64 +KFF9 +Onew
for i in 1 2 3 4 5 6 7 8 9; do same new$i.png changed$i.png; done

new_case 'a still'
quick s.pov +Ostill --resume
exits 0
has still.png still.frames.jsonl
quick s.pov +Ostill --resume +V
says 'still.png: left out'

new_case 'a torn line of the manifest'
head -c 100 whole.frames.jsonl >torn.frames.jsonl
for i in 1 2 3 4 5 6 7 8 9; do cp whole$i.png torn$i.png; done
brume s.pov $film +Otorn +C
exits 0
all_same torn
is "$(lines torn.frames.jsonl)" 10

# Other pieces of time each run, of a film that takes about a second.
new_case 'killed at random, and taken up again'
film='+W24 +H18 --spp 400 +KFF9'
rm -f whole*
brume s.pov $film +Owhole
kills=0
for t in 20 05 31 12 44 08 26 17 03 38; do
    "$BRUME" s.pov $film +Okilled --resume >printed 2>said &
    pid=$!
    sleep 0.$t
    kill -KILL $pid 2>/dev/null
    wait $pid 2>/dev/null
    status=$?
    for picture in killed?.png; do
        [ ! -e "$picture" ] || same "whole${picture#killed}" "$picture"
    done
    # A film that was ready is begun anew.
    if [ "$status" -eq 0 ]; then
        rm -f killed*
    else
        kills=$((kills + 1))
    fi
done
[ "$kills" -gt 1 ] || complain "only $kills were killed in time"
brume s.pov $film +Okilled --resume
exits 0
all_same killed

end_cases
