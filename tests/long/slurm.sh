#!/bin/sh
# Films on Slurm: the example scripts, a task that is requeued, and the same
# bytes as one run. Skipped where no Slurm answers.
. "$(dirname "$0")/../cli/lib"
sinfo -h -o %t 2>/dev/null | grep -qE 'idle|mix' || {
    echo 'no Slurm with an idle node answers'
    exit 77
}
write_scene s.pov
export BRUME
film='s.pov +W24 +H18 --spp 4 +KFF48'
frames=$(seq -w 48)

all_same()
{
    for i in $frames; do
        same whole$i.png "$1$i.png"
    done
}

brume $film +Owhole

new_case 'a job array of eight tasks'
sbatch --wait --array=1-8 -o a.%a.out "$ROOT/scenes/slurm/array.sh" \
    $film +Oarray >printed 2>said
took $?
exits 0
all_same array
is "$(wc -l <array.frames.jsonl)" 48

new_case 'an array that counts otherwise'
sbatch --wait --array=7-11:2 -o b.%a.out "$ROOT/scenes/slurm/array.sh" \
    $film +Oodd >printed 2>said
took $?
exits 0
all_same odd
is "$(wc -l <odd.frames.jsonl)" 48

new_case 'a step of two tasks'
sbatch --wait --ntasks=2 -o c.out "$ROOT/scenes/slurm/step.sh" $film +Ostep \
    >printed 2>said
took $?
exits 0
all_same step
is "$(wc -l <step.frames.jsonl)" 48

new_case 'a film whose fields are filtered'
grids=$ROOT/${B:-build}/tests/bench/grids
"$grids" . t4-smoke >grids.txt
cp "$ROOT"/tests/bench/t4-smoke.* "$ROOT"/tests/bench/bench.inc .
smoke='t4-smoke.ini +KFF48 +W32 +H24 --spp 1 --integrator photon
    --photons 2000 --field-spacing 0.05 +L.'
brume $smoke +Owhole
exits 0
sbatch --wait --array=1-8 -o s.%a.out "$ROOT/scenes/slurm/array.sh" \
    $smoke +Osmoke >printed 2>said
took $?
exits 0
all_same smoke
is "$(wc -l <smoke.frames.jsonl)" 48

# The time limit of a job is whole minutes: it is signalled by hand, then
# requeues itself.
new_case 'SIGTERM, and the rest after a requeue'
job=$(sbatch --parsable --array=1-1 -o d.out "$ROOT/scenes/slurm/array.sh" \
    s.pov +W80 +H60 --spp 64 +KFF48 +Oagain)
wait_for '"frame":5' again.frames.jsonl
scancel --signal=TERM "${job}_1"
for _ in $(seq 300); do
    # Slurm lets a requeued job wait for two minutes.
    scontrol update jobid="${job}_1" StartTime=now 2>/dev/null
    [ "$(wc -l <again.frames.jsonl)" != 48 ] || break
    sleep 0.5
done
is "$(wc -l <again.frames.jsonl)" 48
grep -q 'stopped' d.out || complain 'it was not stopped'
brume s.pov +W80 +H60 --spp 64 +KFF48 +Owhole
all_same again

end_cases
