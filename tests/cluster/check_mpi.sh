#!/usr/bin/env bash
# --mpi under mpirun: the bytes of one process for 4 ranks, for every kind of study that ranks can share; a rank that is
# killed and a run that is terminated, continued with other numbers of ranks and by one process; bad input is said once.
#
#   tests/cluster/check_mpi.sh PROGRAM SOURCE [CAMPAIGNS]
#
#   CAMPAIGNS   the program hidden_campaigns: also a calibration and a diagnosis by one process and by three ranks, one
#               and two ranks for every kind, and kills of other kinds than rows
set -euo pipefail

program=$1 source=$2 campaigns=${3:-}
numbers=(4) killed=(rows)
command -v mpirun >/dev/null || { echo "skipped: no mpirun (Debian: libopenmpi-dev)"; exit 77; }
"$program" info | grep -q "^MPI: .*MPI" || { echo "skipped: the program was built without MPI"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
ranks() { mpirun --oversubscribe -n "$1" "$program" "${@:2}" --mpi --threads 1 --quiet; }
fail() { echo "$*"; exit 1; }

if [[ -n $campaigns ]]; then
    "$campaigns" generate --seeds 11 --short --out lab >/dev/null
    measured=$(ls lab/*.h5) start=$(ls lab/*.toml)
    "$program" diagnose "$measured" --study "$start" -o one.h5 --nulls 12 --quiet >/dev/null
    ranks 3 diagnose "$measured" --study "$start" -o three.h5 --nulls 12 >/dev/null
    cmp one_campaigns.txt three_campaigns.txt || fail "diagnose: other simulated campaigns"
    echo "diagnose: the same campaigns"
    "$program" calibrate "$measured" --study "$start" -o one_fit.h5 --no-held-out --quiet >/dev/null
    ranks 3 calibrate "$measured" --study "$start" -o three_fit.h5 --no-held-out >/dev/null
    # the file has the seconds that it took: one number, 8 bytes in one place
    differing=$(cmp -l one_fit.h5 three_fit.h5 | awk 'NR == 1 { first = $1 } END { print NR ? $1 - first + 1 : 0 }')
    [[ $(stat -c %s one_fit.h5) == $(stat -c %s three_fit.h5) && $differing -le 8 ]] || fail "calibrate: other results"
    echo "calibrate: the same bytes, but for the seconds"
    numbers=(1 2 4) killed=(rows counts adaptive space)
fi

inputs=$source/studies/inputs
axes=(--set surface.frequency_hz='{ from = 4.0, to = 8.0, count = 2 }'
      --set surface.pga_m_s2='{ from = 4.0, to = 12.0, count = 2 }')
declare -A study=([rows]=small_scale_column [counts]=small_scale_column [adaptive]=small_scale_column_adaptive
                  [rare]=rare_collapse [twins]=twins_column [fragility]=fragility_column
                  [sensitivity]=sensitivity_column [space]=round_column)
settings() { # of one kind, one to a line
    case $1 in
    rows) printf '%s\n' "${axes[@]}" --set study.realizations=100 ;;
    counts) printf '%s\n' "${axes[@]}" --set study.realizations=100 --set output.realizations=none ;;
    adaptive) printf '%s\n' "${axes[@]}" --set surface.adaptive.budget=1000 ;;
    rare) printf '%s\n' --set rare.samples=200 --set rare.repeats=5 ;;
    twins) printf '%s\n' "${axes[@]}" --set study.realizations=6 --set twins.followed=1 ;;
    fragility) printf '%s\n' --set study.realizations=2 --set fragility.motions=8 --set fragility.contacts=1 ;;
    sensitivity) printf '%s\n' --set sensitivity.samples=16 ;;
    space) printf '%s\n' --set study.realizations=40 --set structure.blocks=3 --set excitation.cycles=4 \
        --set surface.frequency_hz='{ from = 0.6, to = 1.2, count = 2 }' \
        --set surface.pga_m_s2='{ from = 2.5, to = 7.0, count = 2 }' ;;
    esac
}
for kind in rows counts adaptive rare twins fragility sensitivity space; do
    mapfile -t set < <(settings $kind)
    "$program" run "$inputs/${study[$kind]}.toml" "${set[@]}" -o $kind.h5 --quiet >/dev/null
    for n in "${numbers[@]}"; do
        ranks $n run "$inputs/${study[$kind]}.toml" "${set[@]}" -o ranks.h5 >/dev/null
        cmp $kind.h5 ranks.h5 || fail "$kind: $n ranks"
        rm ranks.h5
    done
    echo "$kind: the same bytes"
done

# SIGKILL of a rank that is not the first, then SIGTERM of all, then to the end: by one process, and by four ranks
for kind in "${killed[@]}"; do
    mapfile -t set < <(settings $kind)
    again() { "${@}" run "$inputs/${study[$kind]}.toml" "${set[@]}" -o stopped.h5 --quiet; }
    for ((i = 0; ; ++i)); do # on a busy machine a run may end before it is killed
        rm -f stopped.h5
        mpirun --oversubscribe -n 3 "$program" run "$inputs/${study[$kind]}.toml" "${set[@]}" -o stopped.h5 --mpi \
            --threads 1 --quiet >killed.log 2>&1 &
        until [[ -e stopped.h5 ]]; do sleep 0.01; done
        kill -KILL "$(pgrep -P $! | tail -1)" 2>/dev/null || true
        if ! wait $!; then break; fi
        [[ $i -lt 20 ]] || fail "$kind: the run ends well without a rank"
    done
    "$program" info stopped.h5 >/dev/null
    mpirun --oversubscribe -n 2 "$program" run "$inputs/${study[$kind]}.toml" "${set[@]}" -o stopped.h5 --mpi \
        --threads 1 --quiet >terminated.log 2>&1 &
    begun=$(stat -c %s stopped.h5)
    while kill -0 $! 2>/dev/null && [[ $(stat -c %s stopped.h5) == "$begun" ]]; do sleep 0.01; done # it goes on
    kill -TERM $! 2>/dev/null || true
    wait $! || true
    "$program" info stopped.h5 >/dev/null
    cp stopped.h5 copy.h5
    again "$program" >/dev/null
    cmp $kind.h5 stopped.h5 || fail "$kind: continued by one process"
    mv copy.h5 stopped.h5
    ranks 4 run "$inputs/${study[$kind]}.toml" "${set[@]}" -o stopped.h5 >/dev/null
    cmp $kind.h5 stopped.h5 || fail "$kind: continued by four ranks"
    rm stopped.h5
    echo "$kind: continued to the same bytes"
done

refused() { # MESSAGE RANKS ARGUMENT...
    local status=0
    ranks "${@:2}" >bad.log 2>&1 || status=$?
    [[ $status == 2 && $(grep -c "^stylobate: " bad.log) == 1 ]] && grep -q -- "$1" bad.log ||
        { cat bad.log; fail "not refused once, with '$1': status $status"; }
}
refused "surface.pga_m_s2" 4 run "$inputs/small_scale_column.toml" --set surface.pga_m_s2=-1
refused "Run it without --mpi" 2 run "$inputs/free_rocking.toml"
refused "there is no such file" 3 calibrate missing.h5
refused "there is no such file" 3 diagnose missing.h5
echo "refused in one message"
