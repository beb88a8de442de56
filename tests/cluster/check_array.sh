#!/usr/bin/env bash
# scripts/slurm/array.sh on a cluster of one machine: eight shards, one of them requeued while it runs, joined to the
# bytes of one run.
#
#   tests/cluster/check_array.sh PROGRAM SOURCE
set -euo pipefail

program=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The program; at its first start the third task is held when it has some rows, so that it does not end before the
# requeue.
cat >program.sh <<'HOLD'
#!/usr/bin/env bash
if [[ ${SLURM_ARRAY_TASK_ID:-} == 3 && ${SLURM_RESTART_COUNT:-0} == 0 ]]; then
    "$PROGRAM" "$@" &
    until [[ $(stat -c %s study_3_of_8.h5 2>/dev/null || echo 0) -gt 60000 ]]; do sleep 0.01; done
    kill -STOP $! && touch third_is_held
    wait
fi
exec "$PROGRAM" "$@"
HOLD
chmod +x program.sh

cat >inside.sh <<'INSIDE'
set -euo pipefail
"$STYLOBATE" run "$STUDY" -o whole.h5 --quiet
job=$(sbatch --parsable --array=1-8 "$SOURCE/scripts/slurm/array.sh")
for ((i = 0; ; ++i)); do # until the third task is held
    [[ -e third_is_held ]] && break
    [[ $i -lt 3000 ]] || { echo "the third task did not run"; squeue; tail ./*.log; exit 1; }
    sleep 0.1
done
scontrol requeue "${job}_3"
echo "requeued task 3 of job $job"
for ((i = 0; ; ++i)); do # until the job that joins them has ended
    state=$(squeue --noheader --format=%T --states=all --name=stylobate_merge)
    [[ $state == COMPLETED ]] && break
    [[ $i -lt 6000 && $state != FAILED && $state != CANCELLED ]] ||
        { echo "the shards were not joined: '$state'"; squeue; tail ./*.log; exit 1; }
    sleep 0.1
done
squeue --states=all --format="%.12i %.16j %.10T %.8M %r"
[[ $(scontrol show job "${job}_3" | grep -o 'Restarts=[0-9]*') == Restarts=1 ]] ||
    { echo "task 3 was not started twice"; exit 1; }
cmp whole.h5 study.h5
INSIDE

sed 's/^realizations = .*/realizations = 400/' "$source/studies/inputs/small_scale_column.toml" |
    sed 's/^frequency_hz = .*/frequency_hz = { from = 4.0, to = 8.0, count = 2 }/; s/^pga_m_s2 = .*/pga_m_s2 = { from = 4.0, to = 12.0, count = 2 }/' >study.toml
export PROGRAM=$program STYLOBATE=$folder/program.sh STUDY=study.toml SOURCE=$source
"$source/tests/cluster/slurm.sh" "$folder/slurm" bash inside.sh
echo "the same bytes"
