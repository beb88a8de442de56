#!/usr/bin/env bash
# One shard of a study for each task of an array job, and a job that joins them when all have ended. A task that is
# requeued or submitted again continues its own file.
#
#   STUDY=my.toml sbatch --array=1-8 [--account=A --partition=P] scripts/slurm/array.sh
#
#   STYLOBATE   the program (default: stylobate)    RESULTS   the joined file (default: the study's name with .h5)
#SBATCH --job-name=stylobate
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=%x_%A_%a.log
set -euo pipefail

program=${STYLOBATE:-stylobate}
: "${STUDY:?give the study file: STUDY=my.toml sbatch --array=1-8 $0}"
name=$(basename "${STUDY%.toml}")
parts=${SLURM_ARRAY_TASK_COUNT:?submit it as an array: sbatch --array=1-8}
results=${RESULTS:-$name.h5}
whole=()
if ((parts == 1)); then
    whole=(-o "$results") # one shard is the study
elif [[ $SLURM_ARRAY_TASK_ID == "$SLURM_ARRAY_TASK_MIN" && ${SLURM_RESTART_COUNT:-0} == 0 ]]; then
    files=$(seq -f "${name}_%.0f_of_$parts.h5" 1 "$parts")
    sbatch --dependency="afterok:$SLURM_ARRAY_JOB_ID" --job-name=stylobate_merge --output=%x_%j.log \
        ${SLURM_JOB_ACCOUNT:+--account="$SLURM_JOB_ACCOUNT"} --partition="$SLURM_JOB_PARTITION" \
        --wrap="'$program' merge $(echo $files) -o '$results' --quiet"
fi
exec "$program" run "$STUDY" --shard "$((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN + 1))/$parts" \
    --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet "${whole[@]}"
