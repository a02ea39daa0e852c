#!/usr/bin/env bash
# A run on a cluster with SLURM:  sbatch -N 2 --ntasks-per-node 32 jobs/batch/slurm.sh SCENE.toml OUT
# The run stops by itself with a checkpoint before the time limit, or on the signal below, and the job queues itself again
# until the scene is done: exit code 75 means "stopped on purpose, resumable".
#SBATCH --job-name=brisance
#SBATCH --time=02:00:00
#SBATCH --signal=USR1@300
#SBATCH --open-mode=append
#SBATCH --output=%x-%j.log
set -u
scene=${1:?usage: sbatch jobs/batch/slurm.sh SCENE.toml OUT}
out=${2:?usage: sbatch jobs/batch/slurm.sh SCENE.toml OUT}
brisance=${BRISANCE:-$SLURM_SUBMIT_DIR/build/release/brisance}

srun "$brisance" run "$scene" --out "$out" --restart auto --walltime 1h50m
code=$?
if [[ $code -eq 75 ]]; then
  sbatch -N "$SLURM_JOB_NUM_NODES" -n "$SLURM_NTASKS" --dependency=afterany:"$SLURM_JOB_ID" \
    "$SLURM_SUBMIT_DIR/jobs/batch/slurm.sh" "$scene" "$out"
  exit 0
fi
exit "$code"
