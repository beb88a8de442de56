#!/usr/bin/env bash
# What the GPUs of this machine compute, and how fast (docs/gpu.md), in at most ten minutes:
#
#   scripts/gpu.sh [--built FOLDER] RESULTS [STUDY...]
#
#   --built FOLDER   takes the programs stylobate, test_ensemble and stylobate_bench from there, and builds nothing
#   RESULTS          folder for what is measured
#   STUDY            names of ready studies; without them, one of each kind that a GPU runs
#
# 1. tests.txt: the tests of slots and lanes, every outcome on the GPU against the processor.
# 2. racecheck.txt: hazards of shared memory, in a small run by lanes.
# 3. bench.json: steps and surfaces by lanes, by threads and on the processor, and the card's peak, in one run. The
#    environment variable BENCHMARKS selects others.
# 4. studies.csv: each study by lanes (where they serve), by threads, and on all threads of the processor; all rows of
#    the results are compared.
# 5. ncu_1.txt, ncu_3.txt: the step by lanes with one and with three warps a scheduler; sass.gz: its machine code.
# What does not fit into the time (SECONDS_IN_ALL, 570) or has no program is named in left_out.txt. Exit status 1 where
# a test fails, a row differs or a hazard is found.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
built=
[[ ${1:-} != --built ]] || { built=$2; shift 2; }
[[ ${1:-} =~ ^[^-] ]] || { sed -n '2,19s/^# \?//p' "$0" >&2; exit 2; }
results=$1
shift
mkdir -p "$results"
: >"$results/left_out.txt"
studies=("$@")
[[ $# -gt 0 ]] || studies=(small_scale_column fragility_column sensitivity_column rare_collapse rigid_column
    synthetic_earthquake strengthening_tendon small_scale_colonnade_drums)
export PATH=$PATH:/usr/local/cuda/bin
until=${SECONDS_IN_ALL:-570}
status=0

# left SECONDS WHAT: whether as much time is left; else WHAT is left out
left() {
    ((SECONDS + $1 <= until)) && return
    echo "$2: no time left" | tee -a "$results/left_out.txt" >&2
    return 1
}
# has PROGRAM WHAT: whether it is there; else WHAT is left out
has() {
    command -v "$1" >/dev/null && return
    echo "$2: there is no $1" | tee -a "$results/left_out.txt" >&2
    return 1
}

if [[ -z $built ]]; then
    cmake --preset release -B build/gpu -DSTYLOBATE_CUDA=ON >/dev/null
    cmake --build build/gpu --target stylobate test_ensemble stylobate_bench --parallel "$(nproc)"
    built=$results/programs
    mkdir -p "$built"
    cp build/gpu/{studies/stylobate,tests/test_ensemble,bench/stylobate_bench} "$built"
fi
stylobate=$built/stylobate
"$stylobate" info | tee "$results/info.txt"
"$stylobate" info --json | grep -q '"gpu": true' || {
    echo "gpu.sh: no GPU can be used here, and nothing is measured; $results/info.txt says why" >&2
    exit 2
}
! command -v nvidia-smi >/dev/null ||
    nvidia-smi --query-gpu=name,clocks.sm,clocks.max.sm,driver_version --format=csv >"$results/card.txt"

timeout 150 "$built/test_ensemble" --gtest_filter='Slots.*:*SlotsOfForm*:Lanes.*:*LanesOfBlocks*:Cuda.*' \
    >"$results/tests.txt" 2>&1 || status=1
tail -n 4 "$results/tests.txt"

if has compute-sanitizer racecheck && left 60 racecheck; then
    timeout 90 compute-sanitizer --tool racecheck --error-exitcode 3 "$built/test_ensemble" \
        --gtest_filter='Cuda.LanesHaveTheBitsOfThreads' >"$results/racecheck.txt" 2>&1 || status=1
    tail -n 2 "$results/racecheck.txt"
fi

! left 60 benchmarks || timeout 120 "$built/stylobate_bench" \
    --benchmark_filter="${BENCHMARKS:-BM_Cuda|BM_PeakFma|BM_Ensemble/.*/$(nproc)}" \
    --benchmark_out="$results/bench.json" --benchmark_out_format=json --benchmark_repetitions=1 || status=1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Seconds that a run took, by its summary.
seconds() { sed -n 's/.*"seconds": \([0-9.e+-]*\).*/\1/p' "$1"; }
# run WAY BACKEND: one run of the study, and its rows
run() {
    STYLOBATE_DEVICE_STEP=$1 "$stylobate" run "studies/inputs/$study.toml" --backend "$2" -o "$work/$1.h5" --quiet \
        --json >"$work/$1.json"
    "$stylobate" export "$work/$1.h5" --to csv -o "$work/$1" --force >/dev/null
}
echo "study,realizations,GPU by lanes s,GPU by threads s,processor s,rows" >"$results/studies.csv"
for study in "${studies[@]}"; do
    left 60 "$study" || continue
    rows=equal
    run lanes cuda
    run threads cuda
    run processor cpu
    for way in lanes threads; do
        diff -rq "$work/$way" "$work/processor" >/dev/null || { rows=differ; status=1; }
    done
    count=$(sed -n 's/.*"realizations": \([0-9]*\).*/\1/p' "$work/lanes.json")
    echo "$study,$count,$(seconds "$work/lanes.json"),$(seconds "$work/threads.json"),$(seconds "$work/processor.json"),$rows" |
        tee -a "$results/studies.csv"
    rm -rf "${work:?}"/*
done

for warps in 1 3; do
    has ncu "ncu, $warps warps a scheduler" && left 40 "ncu, $warps warps a scheduler" || continue
    timeout 60 ncu --clock-control none --set full -k regex:step_slots --launch-skip 5 --launch-count 1 \
        "$built/stylobate_bench" --benchmark_filter="BM_CudaStep/lanes/$((2640 * warps))\$" \
        >"$results/ncu_$warps.txt" 2>&1 || status=1
    grep -E "Duration|Executed Ipc Active|No Eligible|Registers Per|Achieved Occ" "$results/ncu_$warps.txt" || true
done
! has cuobjdump "machine code" || cuobjdump --dump-sass "$built/stylobate_bench" 2>/dev/null | gzip >"$results/sass.gz"
echo "done in $SECONDS s"
exit $status
