#!/usr/bin/env bash
# Builds and runs the work-precision measurements: bench/results/work-precision.md and its picture beside it. A few
# minutes on one core. What follows from them is said in docs/work_precision.md.
#
#   scripts/work_precision.sh [--realizations N]        of each ensemble; 1024 unless given
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build build/release --target work_precision --parallel "$(nproc)"
mkdir -p bench/results
build/release/bench/work_precision/work_precision --page bench/results/work-precision.md \
    --picture bench/results/work-precision.png "$@"
