#!/usr/bin/env bash
# Builds the benchmarks and writes their results to bench/results/COMMIT-PROCESSOR.json.
#
#   scripts/bench.sh [GOOGLE BENCHMARK ARGUMENTS]        for example --benchmark_filter=BM_Step
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build build/release --target stylobate_bench --parallel "$(nproc)"

commit=$(git describe --always --dirty --exclude='*' --abbrev=10 2>/dev/null || echo unknown)
mkdir -p bench/results
new=$(mktemp "bench/results/$commit.XXXXXX")
trap 'rm -f "$new"' EXIT
build/release/bench/stylobate_bench --benchmark_out="$new" --benchmark_out_format=json "$@"
processor=$(sed -n 's/^ *"processor": "\(.*\)",*$/\1/p' "$new" | tr -cs 'A-Za-z0-9.\n' '-' | sed 's/^-*//; s/-*$//')
out=bench/results/$commit-${processor:-unknown}.json
# only the processor and the commit are recorded, not the name of the machine
sed '/"host_name":/d' "$new" >"$out"
echo "$out"
