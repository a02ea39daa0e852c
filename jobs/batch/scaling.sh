#!/usr/bin/env bash
# Strong scaling on one node with SLURM:  sbatch --exclusive -N 1 jobs/batch/scaling.sh SCENE.toml OUT STEPS
# One run of STEPS steps per rank count; "wall_s" in OUT/nRANKS/summary.json is the time of each.
#SBATCH --job-name=brisance-scaling
#SBATCH --time=01:00:00
#SBATCH --output=%x-%j.log
set -eu
scene=${1:?usage: sbatch jobs/batch/scaling.sh SCENE.toml OUT STEPS}
out=${2:?usage: sbatch jobs/batch/scaling.sh SCENE.toml OUT STEPS}
steps=${3:?usage: sbatch jobs/batch/scaling.sh SCENE.toml OUT STEPS}
brisance=${BRISANCE:-$SLURM_SUBMIT_DIR/build/release/brisance}

for ((ranks = 1; ranks <= SLURM_CPUS_ON_NODE; ranks *= 2)); do
  srun -n "$ranks" "$brisance" run "$scene" --out "$out/n$ranks" --steps "$steps" --quiet
done
