#!/usr/bin/env bash
# Measures, and writes the tables into a page of docs. It takes minutes; options are those of the program in bench/.
#
#   scripts/tables.sh conventions         what each convention of a study changes in one collapse probability
#   scripts/tables.sh coverage            the intervals of fragility estimates
#   scripts/tables.sh risk_coverage       the intervals of annual frequencies
#   scripts/tables.sh sampling_coverage   the intervals of rare events and of Sobol's indices
#   scripts/tables.sh rigid_limit         what the first table of the page shows of rigid blocks; nothing is simulated
#   scripts/tables.sh work_precision      error against cost, with a picture; the machine need not be idle
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
name=${1:-}
shift || true
program=stylobate_$name place=bench options=()
case $name in
conventions | sampling_coverage) page=docs/sensitivity.md ;;
coverage) page=docs/fragility_statistics.md ;;
risk_coverage) page=docs/risk.md ;;
rigid_limit) page=docs/rigid_limit.md options=(--agreement docs/rigid_limit.md) ;;
work_precision)
    program=$name place=bench/$name page=docs/work_precision.md options=(--picture docs/images/work_precision.png)
    ;;
*) sed -n '2,/^set/s/^# \?//p' "$0" >&2 && exit 2 ;;
esac
. scripts/built.sh "$program"
"$build/$place/$program" "${options[@]}" "$@" | scripts/into_page.sh "tables.sh $name" "$page"
