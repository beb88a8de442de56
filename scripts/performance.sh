#!/usr/bin/env bash
# Runs the benchmarks and writes their tables into docs/performance.md. Ten minutes; on an idle machine.
#
#   scripts/performance.sh [RESULTS.json]      from existing results, without running the benchmarks
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
if [[ $# -eq 0 ]]; then
    results=$(scripts/bench.sh --benchmark_repetitions=3 --benchmark_min_time=0.2 | tail -n 1)
else
    results=$1
fi
[[ -n ${STYLOBATE_BUILD:-} ]] || cmake --build build/release --target performance_page instructions >/dev/null
bench=${STYLOBATE_BUILD:-build/release}/bench

{ "$bench/performance_page" "$results"; echo; "$bench/instructions"; } |
    scripts/into_page.sh performance.sh docs/performance.md
