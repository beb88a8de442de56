#!/usr/bin/env bash
# Runs the benchmarks and writes their tables into docs/performance.md. Tens of minutes, on an idle machine.
#
#   scripts/performance.sh [--row] [RESULTS.json]
#
#   --row          only the row of this kind of processor; the page's other tables stay those of another machine
#   RESULTS.json   existing results, without running the benchmarks
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
row_only=false
if [[ ${1:-} == --row ]]; then
    row_only=true
    shift
fi
if [[ $# -eq 0 ]]; then
    results=$(scripts/bench.sh --benchmark_repetitions=3 --benchmark_min_time=0.2 | tail -n 1)
else
    results=$1
fi
[[ -n ${STYLOBATE_BUILD:-} ]] || cmake --build build/release --target performance_page instructions >/dev/null
bench=${STYLOBATE_BUILD:-build/release}/bench

for page in README.md docs/performance.md; do
    "$bench/performance_page" --kinds bench/results | scripts/into_page.sh "performance.sh --row" "$page"
done
$row_only || { "$bench/performance_page" "$results"; echo; "$bench/instructions"; } |
    scripts/into_page.sh performance.sh docs/performance.md
