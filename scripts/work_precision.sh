#!/usr/bin/env bash
# Measures error against cost and writes the tables into docs/work_precision.md, with their picture. Costs are counted
# in steps, so the machine need not be idle. Four minutes of one core.
#
#   scripts/work_precision.sh [--realizations N]        of each ensemble; 1024 unless given
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
build=${STYLOBATE_BUILD:-build/release}
if [[ -z ${STYLOBATE_BUILD:-} ]]; then
    scripts/install_packages.sh
    cmake --preset release >/dev/null
    cmake --build "$build" --target work_precision --parallel "$(nproc)"
fi

page=docs/work_precision.md
tables=$(mktemp)
trap 'rm -f "$tables" "$tables.page"' EXIT
"$build/bench/work_precision/work_precision" --picture docs/images/work_precision.png "$@" >"$tables"
awk -v tables="$tables" '
    /<!-- end of what scripts\/work_precision.sh writes -->/ { inside = 0 }
    !inside { print }
    /<!-- scripts\/work_precision.sh writes what follows -->/ { inside = 1; print ""; while ((getline line < tables) > 0) print line }
' "$page" >"$tables.page"
cat "$tables.page" >"$page"
echo "$page"
