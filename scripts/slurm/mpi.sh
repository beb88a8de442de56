#!/usr/bin/env bash
# One study by the processes of a job. A job that is requeued or submitted again continues its results.
#
#   STUDY=my.toml sbatch --ntasks=8 --cpus-per-task=4 [--account=A --partition=P] scripts/slurm/mpi.sh
#
#   STYLOBATE   the program (default: stylobate)    RESULTS   its results (default: the study's name with .h5)
#   LAUNCH      what starts the processes (default: mpirun, bound to the cores of their task); another MPI than Open MPI
#               may want LAUNCH="srun --mpi=pmi2 --kill-on-bad-exit=1"
#SBATCH --job-name=stylobate
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=%x_%j.log
set -euo pipefail

: "${STUDY:?give the study file: STUDY=my.toml sbatch --ntasks=8 $0}"
threads=${SLURM_CPUS_PER_TASK:-1}
name=$(basename "${STUDY%.toml}")
exec ${LAUNCH:-mpirun --map-by "slot:PE=$threads"} "${STYLOBATE:-stylobate}" run "$STUDY" \
    -o "${RESULTS:-$name.h5}" --mpi --threads "$threads" --quiet
