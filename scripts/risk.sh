#!/usr/bin/env bash
# Runs the worked example of docs/risk.md (two ready fragility studies over power-law hazards) and writes its results and
# its picture there.
#
#   scripts/risk.sh [HISTORIES]    simulated histories of a hundred years (default 1000: minutes)
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
root=$PWD
. scripts/built.sh stylobate
stylobate=$(realpath "$build/studies/stylobate")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

shown() { # a command line as a reader types it, and what it prints
    printf '```\n$ stylobate %s\n' "$*"
    (cd "$work" && "$stylobate" "$@" 2>/dev/null)
    printf '```\n'
}

for name in column colonnade; do
    (cd "$work" && "$stylobate" run "$root/studies/inputs/fragility_$name.toml" -o "$name.h5" --quiet >/dev/null)
done
{
    echo "A column under near-fault pulses, with a hundred years simulated:"
    echo
    shown risk column.h5 --hazard k0=1e-3,k=3,measure=pgv,sigma_ln=0.5 --sequences "${1:-1000}" --threshold 0.4
    echo
    echo "The same hazard as a table, with its fractiles 0.05 and 0.95:"
    echo
    python3 - >"$work/hazard.csv" <<'TABLE'
import math
print("pgv_cm_s,annual_frequency,low,high")
for cm in (5, 10, 20, 50, 100, 200, 500):
    rate, wide = 1e-3 * (cm / 100) ** -3, math.exp(1.6448536 * 0.5)
    print(f"{cm},{rate:.6g},{rate / wide:.6g},{rate * wide:.6g}")
TABLE
    printf '```\n'
    cat "$work/hazard.csv"
    printf '```\n\n'
    shown risk column.h5 --hazard hazard.csv --state collapse -o table_risk.h5
    echo
    echo "A colonnade under synthetic earthquakes:"
    echo
    shown risk colonnade.h5 --hazard k0=6e-3,k=2.5,measure=sa_1s,sigma_ln=0.5
} >"$work/page.md"
(cd "$work" && "$stylobate" export column_risk.h5 --to png -o risk.png >/dev/null)
cp "$work/risk.png" docs/images/risk_column.png
scripts/into_page.sh risk.sh docs/risk.md <"$work/page.md"
