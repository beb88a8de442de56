#!/usr/bin/env bash
# What the GPUs of this machine compute, and how fast (docs/gpu.md):
#
#   scripts/gpu.sh [--built FOLDER] RESULTS [STUDY...]
#
#   --built FOLDER   takes the programs stylobate, test_ensemble and stylobate_bench from there, and builds nothing
#   RESULTS          folder for what is measured
#   STUDY            names of ready studies; without them, one of each kind that a GPU runs
#
# 1. The tests of the slots: every outcome on the GPU against the lanes of the processor.
# 2. Each study on the GPU and on the processor: all rows of the two results files are compared.
# 3. The benchmarks that the environment variable BENCHMARKS selects. Minutes in all. Exit status 1 where a test fails or a row differs.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
built=
[[ ${1:-} != --built ]] || { built=$2; shift 2; }
[[ ${1:-} =~ ^[^-] ]] || { sed -n '2,12s/^# \?//p' "$0" >&2; exit 2; }
results=$1
shift
mkdir -p "$results"
studies=("$@")
[[ $# -gt 0 ]] || studies=(small_scale_column rigid_column fragility_column small_scale_colonnade_drums
    synthetic_earthquake sensitivity_column rare_collapse strengthening_tendon)
if [[ -z $built ]]; then
    cmake --preset release -B build/gpu -DSTYLOBATE_CUDA=ON >/dev/null
    cmake --build build/gpu --target stylobate test_ensemble stylobate_bench --parallel "$(nproc)"
    built=$results/programs
    mkdir -p "$built"
    cp build/gpu/{studies/stylobate,tests/test_ensemble,bench/stylobate_bench} "$built"
fi
stylobate=$built/stylobate
"$stylobate" info | tee "$results/info.txt"

status=0
"$built/test_ensemble" --gtest_filter='Slots.*:*SlotsOfForm*:Cuda.*' >"$results/tests.txt" 2>&1 || status=1
tail -n 4 "$results/tests.txt"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Seconds that a run took, by its summary.
seconds() { sed -n 's/.*"seconds": \([0-9.e+-]*\).*/\1/p' "$1"; }
echo "study,realizations,GPU s,processor s,rows" >"$results/studies.csv"
for study in "${studies[@]}"; do
    rows=equal
    for backend in cuda cpu; do
        "$stylobate" run "studies/inputs/$study.toml" --backend $backend -o "$work/$backend.h5" --quiet --json \
            >"$work/$backend.json"
        "$stylobate" export "$work/$backend.h5" --to csv -o "$work/$backend" --force >/dev/null
    done
    diff -rq "$work/cuda" "$work/cpu" >/dev/null || { rows=differ; status=1; }
    count=$(sed -n 's/.*"realizations": \([0-9]*\).*/\1/p' "$work/cuda.json")
    echo "$study,$count,$(seconds "$work/cuda.json"),$(seconds "$work/cpu.json"),$rows" | tee -a "$results/studies.csv"
    rm -rf "${work:?}"/*
done

"$built/stylobate_bench" --benchmark_filter="${BENCHMARKS:-BM_Cuda|BM_PeakFma|BM_Ensemble}" \
    --benchmark_out="$results/bench.json" --benchmark_out_format=json --benchmark_repetitions=1
exit $status
