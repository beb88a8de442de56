#!/usr/bin/env bash
# The scripts of scripts/slurm on a cluster of one machine, or of the hosts of hosts.sh: eight shards as an array job,
# one of which is requeued while it runs, and an array of one task, or three processes as an MPI job that is requeued.
# The results have the bytes of one run.
#
#   tests/cluster/check_job.sh array|mpi PROGRAM SOURCE
set -euo pipefail

kind=$1 program=$2 source=$3
if [[ $kind == mpi ]]; then
    command -v mpirun >/dev/null && "$program" info | grep -q "^MPI: .*MPI" ||
        { echo "skipped: no mpirun, or a program without MPI"; exit 77; }
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    export LAUNCH="mpirun --bind-to none" # the cluster has more cores than the machine
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# The program; at its first start one process is held when its file has some rows, so that the job does not end before
# the requeue.
cat >program.sh <<'HOLD'
#!/usr/bin/env bash
if [[ ${SLURM_ARRAY_TASK_ID:-} == 3 ]]; then file=study_3_of_8.h5; fi
if [[ ${OMPI_COMM_WORLD_RANK:-} == 0 ]]; then file=study.h5; fi
if [[ -n ${file:-} && ${SLURM_RESTART_COUNT:-0} == 0 ]]; then
    "$PROGRAM" "$@" &
    until [[ $(stat -c %s $file 2>/dev/null || echo 0) -gt 60000 ]]; do sleep 0.01; done
    kill -STOP $! && touch held
    wait
fi
exec "$PROGRAM" "$@"
HOLD
chmod +x program.sh

cat >inside.sh <<'INSIDE'
set -euo pipefail
"$PROGRAM" run "$STUDY" -o whole.h5 --quiet
case $KIND in
array)
    job=$(sbatch --parsable --array=1-8 "$SOURCE/scripts/slurm/array.sh")
    requeued=${job}_3 last=stylobate_merge ;;
mpi)
    job=$(sbatch --parsable --ntasks=3 "$SOURCE/scripts/slurm/mpi.sh")
    requeued=$job last=stylobate ;;
esac
for ((i = 0; ; ++i)); do # until one process is held
    [[ -e held ]] && break
    [[ $i -lt 3000 ]] || { echo "what is to be requeued did not run"; squeue; tail ./*.log; exit 1; }
    sleep 0.1
done
scontrol requeue "$requeued"
echo "requeued $requeued"
for ((i = 0; ; ++i)); do # until the last job has ended
    state=$(squeue --noheader --format=%T --states=all --name=$last)
    [[ $state == COMPLETED ]] && break
    [[ $i -lt 6000 && $state != FAILED && $state != CANCELLED ]] ||
        { echo "the results are not there: '$state'"; squeue; tail ./*.log; exit 1; }
    sleep 0.1
done
squeue --states=all --format="%.12i %.16j %.10T %.8M %r %N"
used=$(scontrol show hostnames "$(squeue --states=all --noheader --format=%N | paste -sd,)" | sort -u | wc -l)
[[ -z ${HOSTS:-} || $used -gt 1 ]] || { echo "one of the hosts did everything"; exit 1; }
[[ $(scontrol show job "$requeued" | grep -o 'Restarts=[0-9]*') == Restarts=1 ]] ||
    { echo "$requeued was not started twice"; exit 1; }
cmp whole.h5 study.h5
[[ $KIND == mpi ]] || { # one task is the whole study
    RESULTS=one.h5 sbatch --wait --array=1-1 "$SOURCE/scripts/slurm/array.sh"
    cmp whole.h5 one.h5
}
INSIDE

sed 's/^realizations = .*/realizations = 400/' "$source/studies/inputs/small_scale_column.toml" |
    sed 's/^frequency_hz = .*/frequency_hz = { from = 4.0, to = 8.0, count = 2 }/; s/^pga_m_s2 = .*/pga_m_s2 = { from = 4.0, to = 12.0, count = 2 }/' >study.toml
export KIND=$kind PROGRAM=$program STYLOBATE=$folder/program.sh STUDY=study.toml SOURCE=$source
"$source/tests/cluster/slurm.sh" "$folder/slurm" bash inside.sh
echo "the same bytes"
