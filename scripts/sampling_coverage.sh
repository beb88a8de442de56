#!/usr/bin/env bash
# Measures the coverage of the intervals of rare events and of Sobol's indices, and writes the tables into
# docs/sensitivity.md.
#
#   scripts/sampling_coverage.sh [REPEATS]    estimates of each kind (default 2000: tens of minutes)
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
. scripts/built.sh stylobate_sampling_coverage

"$build/bench/stylobate_sampling_coverage" --repeats "${1:-2000}" |
    scripts/into_page.sh sampling_coverage.sh docs/sensitivity.md
