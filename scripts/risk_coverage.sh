#!/usr/bin/env bash
# Measures the coverage of the intervals of annual frequencies, and writes the table into docs/risk.md.
#
#   scripts/risk_coverage.sh [REPEATS]    simulated campaigns of each kind (default 2000: minutes)
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
. scripts/built.sh stylobate_risk_coverage

"$build/bench/stylobate_risk_coverage" --repeats "${1:-2000}" |
    scripts/into_page.sh risk_coverage.sh docs/risk.md
