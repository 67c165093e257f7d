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

# sbatch_film SCRIPT NAME SWITCH FILM...: as Slurm deals it, it is the whole.
sbatch_film()
{
    script=$1 name=$2 switch=$3
    shift 3
    sbatch --wait "$switch" -o "$name.%a.out" "$ROOT/scenes/slurm/$script" \
        "$@" "+O$name" >printed 2>said
    took $?
    exits 0
    all_same "$name"
    is "$(wc -l <"$name.frames.jsonl")" 48
}

brume $film +Owhole

new_case 'a job array of eight tasks'
sbatch_film array.sh array --array=1-8 $film

new_case 'an array that counts otherwise'
sbatch_film array.sh odd --array=7-11:2 $film

new_case 'a step of two tasks'
sbatch_film step.sh step --ntasks=2 $film

new_case 'a film whose fields are filtered'
grids=$ROOT/${B:-build}/tests/bench/grids
"$grids" . t4-smoke >grids.txt
cp "$ROOT"/tests/bench/t4-smoke.* "$ROOT"/tests/bench/bench.inc .
smoke='t4-smoke.ini +KFF48 +W32 +H24 --spp 1 --integrator photon
    --photons 2000 --field-spacing 0.05 +L.'
brume $smoke +Owhole
exits 0
sbatch_film array.sh smoke --array=1-8 $smoke

# The time limit of a job is whole minutes: it is signalled by hand, then
# requeues itself.
new_case 'SIGTERM, and the rest after a requeue'
job=$(sbatch --parsable --array=1-1 -o d.out "$ROOT/scenes/slurm/array.sh" \
    s.pov +W80 +H60 --spp 64 +KFF48 +Oagain)
wait_for '"frame":5' again.frames.jsonl
scancel --signal=TERM "${job}_1"
# A job's leave to run that is given again in the second in which it was taken
# back is void, and the job with it.
sleep 5
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
