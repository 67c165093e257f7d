#!/bin/bash
# A film as a Slurm job array: each task renders its run of frames.
#
#   sbatch --array=1-8 scenes/slurm/array.sh scenes/campfire.ini
#
# What follows the script goes to brume. A task that was requeued, or the whole
# array once more, renders only what is not finished: --resume.
#SBATCH --job-name=brume
#SBATCH --ntasks=1
#SBATCH --requeue
#SBATCH --open-mode=append
# SIGTERM 60 s before the time is up: brume ends by itself, with status 75.
#SBATCH --signal=TERM@60

srun "${BRUME:-brume}" --shard slurm --resume "$@"
status=$?
# Back into the queue for the rest.
if [ $status = 75 ]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
fi
exit $status
