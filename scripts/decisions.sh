#!/usr/bin/env bash
# Runs the ready studies of decisions (which strengthening helps, what is the risk, what does the survival of the column
# still stands) and writes their results and pictures into docs/decisions.md.
#
#   scripts/decisions.sh     tens of minutes
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
root=$PWD
. scripts/built.sh stylobate
stylobate=$(realpath "$build/studies/stylobate")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
inputs=$root/studies/inputs images=$root/docs/images

compared() { # a row for each variant
    python3 - "$1" "$2" <<'ROWS'
import json, sys
comparison = json.load(open(sys.argv[1]))
for variant in comparison["variants"]:
    limit = variant["limit_states"]["collapse"]
    all_cells = limit["overall"]
    print(f"| {sys.argv[2]} | `{variant['name']}` | {all_cells['base']['probability']:.3f} | "
          f"{all_cells['variant']['probability']:.3f} | "
          f"{all_cells['difference']:+.3f} ({all_cells['lower']:+.3f} to {all_cells['upper']:+.3f}) | "
          f"{all_cells['verdict']} | {len(limit['better_cells'])}, {len(limit['worse_cells'])} | "
          f"{all_cells['saving']:.1f} |")
ROWS
}

{
    echo "Collapse, over all cells with equal weights; intervals of 95 %. Cells are named by exact tests with false names"
    echo "of at most 5 % among them. The last column: how many times as many realizations an unpaired comparison needs for the same"
    echo "interval. It is below 1 where whole cells change from collapse to none: pairs gain nothing there, and their interval is"
    echo "the wider one."
    echo
    echo "| study | variant | base | variant | difference | verdict | cells better, worse | unpaired |"
    echo "|---|---|---:|---:|---:|---|---:|---:|"
    for study in small_scale_strengthened strengthening_dowels strengthening_tendon strengthening_joints isolated_column \
        small_scale_restored restored_column small_scale_clamped clamped_colonnade; do
        "$stylobate" compare "$inputs/$study.toml" -o "$study.cmp.h5" --json --quiet >"$study.json"
        "$stylobate" export "$study.cmp.h5" --to png -o "$images/decisions_$study.png" --force --quiet >/dev/null
        compared "$study.json" "$study"
    done
    echo
    echo '```'
    echo "$ stylobate run monument_risk.toml -o monument.h5"
    "$stylobate" run "$inputs/monument_risk.toml" -o monument.h5 --quiet >/dev/null
    echo "$ stylobate risk monument.h5 --hazard k0=1e-3,k=3,measure=pgv,sigma_ln=0.5 --state collapse"
    "$stylobate" risk monument.h5 --hazard k0=1e-3,k=3,measure=pgv,sigma_ln=0.5 --state collapse 2>/dev/null
    echo '```'
    "$stylobate" export monument_risk.h5 --to png -o "$images/decisions_monument_risk.png" --force --quiet >/dev/null
    echo
    echo '```'
    echo "$ stylobate run monument_past.toml -o past.h5"
    "$stylobate" run "$inputs/monument_past.toml" -o past.h5 2>/dev/null
    echo '```'
    "$stylobate" export past.h5 --to png --picture likelihood -o "$images/decisions_monument_past.png" --force --quiet >/dev/null
} >page.md
cd "$root"
scripts/into_page.sh decisions.sh docs/decisions.md <"$work/page.md"
