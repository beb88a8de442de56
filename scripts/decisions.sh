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

compared() { # overall FILE STUDY: a row for each variant; capacities FILE STUDY: its ratio at each frequency
    python3 - "$@" <<'ROWS'
import json, sys
what, file, study = sys.argv[1:]

def ratio(row):
    if row["ratio"] is None:
        return "–"
    bound = ("?" if row["at_most"] else "≥ ") if row["at_least"] else "≤ " if row["at_most"] else ""
    return f"{bound}{row['ratio']:.2f} ({row['lower']:.2f} to {row['upper']:.2f}) × {row['steps']:.2f}"

for variant in json.load(open(file))["variants"]:
    limit = variant["limit_states"]["collapse"]
    if what == "capacities":
        print(f"| {study} | `{variant['name']}` | " + " | ".join(map(ratio, limit["capacity_ratios"])) + " |")
        continue
    all_cells = limit["overall"]
    saving = all_cells["saving"]
    print(f"| {study} | `{variant['name']}` | {all_cells['base']['probability']:.3f} | "
          f"{all_cells['variant']['probability']:.3f} | "
          f"{all_cells['difference']:+.3f} ({all_cells['lower']:+.3f} to {all_cells['upper']:+.3f}) | "
          f"{all_cells['verdict']} | {len(limit['better_cells'])}, {len(limit['worse_cells'])} | "
          f"{'–' if saving is None else format(saving, '.1f')} |")
ROWS
}
studies="small_scale_strengthened strengthening_dowels strengthening_tendon strengthening_joints isolated_column
    small_scale_restored restored_column small_scale_clamped clamped_colonnade"
frequencies="0.5 | 0.77 | 1.18 | 1.81 | 2.77 | 4.25 | 6.52 | 10 Hz"
for study in $studies; do
    # many intensities with few realizations each: the same number of realizations
    from=$(sed -n 's/^pga_m_s2 = { from = \([0-9.]*\), to = \([0-9.]*\),.*/\1/p' "$inputs/$study.toml")
    to=$(sed -n 's/^pga_m_s2 = { from = \([0-9.]*\), to = \([0-9.]*\),.*/\2/p' "$inputs/$study.toml")
    mkdir -p fine
    "$stylobate" compare "$inputs/$study.toml" -o "fine/$study.cmp.h5" --json --quiet --set study.realizations=12 \
        --set "surface.pga_m_s2={ from = $from, to = $to, count = 24, spacing = \"log\" }" >"fine/$study.json"
    "$stylobate" compare "$inputs/$study.toml" -o "$study.cmp.h5" --json --quiet >"$study.json"
    "$stylobate" export "$study.cmp.h5" --to png -o "$images/decisions_$study.png" --force --quiet >/dev/null
done

{
    echo "**Capacities.** The PGA at which the column falls, over that of the same column without the intervention: the ratio of"
    echo "the geometric means at each frequency, with paired intervals of 95 % ([compare.md](compare.md#capacities)). ≥ and ≤: a"
    echo "bound, since the two still differ at an end of the range of PGA; –: no PGA of the range separates them. × f: the ratio"
    echo "may be off by the factor f, since the shares between two of the 24 PGA are not known. Columns that fall or stand with"
    echo "certainty have all of their capacities between two of them."
    echo
    echo "| study | variant | $frequencies |"
    echo "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|"
    for study in $studies; do
        compared capacities "fine/$study.json" "$study"
    done
    echo
    echo "**Strokes and forces.** Of the realization with the largest displacement of its top among those that stand at a"
    echo "frequency, up to the strongest shaking of the study (16 m/s2 full scale, 12 m/s2 small scale). The ground itself moves"
    echo "by 1.62 m to either side at 0.5 Hz and 16 m/s2. The column of full scale weighs 255 kN, the small one 8 N."
    echo
    echo "| study | variant | | $frequencies |"
    echo "|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|"
    while read -r study variant weight; do
        "$root/scripts/demands.py" "$stylobate" "$inputs/$study.toml" "$variant" "${study}_$variant.h5" "$weight"
    done <<'PARTS'
isolated_column slider 255e3
isolated_column pendulum 255e3
isolated_column elastomeric 255e3
small_scale_strengthened pendulum 8
strengthening_tendon taut 255e3
strengthening_tendon third_of_weight 255e3
strengthening_tendon whole_weight 255e3
small_scale_strengthened tendon 8
PARTS
    echo
    echo "**Shares over the map.** Collapse, over all cells with equal weights; intervals of 95 %. Means over a map depend on its"
    echo "range, and cannot be compared between structures. Cells are named by exact tests with false names of at most 5 % among"
    echo "them. The last column: how many times as many realizations of two studies drawn independently give the difference the same"
    echo "variance. It is 1 where every change is in one direction from or to certainty, and below 1 where more pairs differ than if"
    echo "the two were independent."
    echo
    echo "| study | variant | base | variant | difference | verdict | cells better, worse | unpaired |"
    echo "|---|---|---:|---:|---:|---|---:|---:|"
    for study in $studies; do
        compared overall "$study.json" "$study"
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
