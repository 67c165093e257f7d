#!/bin/bash
# A film as one Slurm job: srun starts a task for each part of the frames.
#
#   sbatch --ntasks=4 scenes/slurm/step.sh scenes/campfire.ini
#
# What follows the script goes to brume.
#SBATCH --job-name=brume
#SBATCH --open-mode=append

# Each task has the processors that it was given, and no more threads.
exec srun "${BRUME:-brume}" --shard slurm --resume \
    +WT"${SLURM_CPUS_PER_TASK:-1}" "$@"
