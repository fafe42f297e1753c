#!/bin/bash
# A sweep as one Slurm job on two nodes: sbatch slurm.sh. Send it again with RESUME=--resume if the time was too short.
#SBATCH --job-name=softshadow
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=16
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=2G
#SBATCH --time=02:00:00
set -eu
file="$PWD/scheduler-$SLURM_JOB_ID.json"
export OPENBLAS_NUM_THREADS=1

dask scheduler --no-dashboard --scheduler-file "$file" &
while [ ! -s "$file" ]; do sleep 1; done
srun dask worker --scheduler-file "$file" --nthreads 1 --memory-limit 2GB &
address=$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["address"])' "$file")
softshadow sweep sweep.toml --scheduler "$address" ${RESUME:-}
