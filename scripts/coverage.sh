#!/usr/bin/env bash
# Measures the coverage of the intervals of fragility estimates, and writes the tables into
# docs/fragility_statistics.md.
#
#   scripts/coverage.sh [REPEATS]    simulated campaigns of each kind (default 10000: minutes)
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
. scripts/built.sh stylobate_coverage

"$build/bench/stylobate_coverage" --repeats "${1:-10000}" |
    scripts/into_page.sh coverage.sh docs/fragility_statistics.md
