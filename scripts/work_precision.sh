#!/usr/bin/env bash
# Measures error against cost and writes the tables into docs/work_precision.md, with their picture. Costs are counted
# in steps, so the machine need not be idle. It takes minutes.
#
#   scripts/work_precision.sh [--realizations N]        of each ensemble; 1024 unless given
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
. scripts/built.sh work_precision

"$build/bench/work_precision/work_precision" --picture docs/images/work_precision.png "$@" |
    scripts/into_page.sh work_precision.sh docs/work_precision.md
