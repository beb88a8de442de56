#!/usr/bin/env bash
# The hidden-effect tests: makes virtual shake-table campaigns of fresh seeds (tests/hidden), diagnoses each, and scores
# the diagnoses. An interrupted run continues: existing campaigns and diagnoses are reused.
#
#   scripts/hidden.sh A..B                    seeds A to B, in results/hidden/A..B; minutes for each campaign
#   scripts/hidden.sh each SEED               one campaign with each effect, from this seed on, in the order of
#                                             `hidden_campaigns effects`; in results/hidden/each_SEED
#   scripts/hidden.sh A..B -- OPTION...       options for every `stylobate diagnose`
#
# The tables go to the terminal and to results/hidden/A..B/score.md. Exit status: that of the score; a failed
# diagnosis is reported, its message is in diagnoses/SEED.log, and its campaign counts as not diagnosed.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

each=
if [[ ${1:-} == each && ${2:-} =~ ^[0-9]+$ ]]; then
    each=$2
    shift
elif [[ $# -lt 1 || ! $1 =~ ^[0-9]+(\.\.[0-9]+)?$ ]]; then
    echo "scripts/hidden.sh: give the seeds as A..B, for example 1000..1059, or each SEED" >&2
    exit 2
fi
seeds=$1
shift
[[ ${1:-} == -- ]] && shift

cmake --preset release >/dev/null
cmake --build build/release --target stylobate hidden_campaigns --parallel "$(nproc)"
hidden=build/release/tests/hidden/hidden_campaigns
stylobate=build/release/studies/stylobate

place=results/hidden/${each:+each_}$seeds
mkdir -p "$place/diagnoses"
if [[ -n $each ]]; then
    mapfile -t effects < <("$hidden" effects)
    seeds=$each..$((each + ${#effects[@]} - 1))
    for k in "${!effects[@]}"; do
        "$hidden" generate --seeds $((each + k)) --effect "${effects[k]}" --out "$place"
    done
else
    "$hidden" generate --seeds "$seeds" --out "$place"
fi
for ((seed = ${seeds%%..*}; seed <= ${seeds##*..}; ++seed)); do
    said=$place/diagnoses/$seed
    [[ -e $said.json ]] && continue
    echo "diagnosis of campaign $seed"
    if "$stylobate" diagnose "$place/campaign_$seed.h5" --study "$place/campaign_$seed.toml" \
        -o "$said.h5" --force --quiet --json "$@" >"$said.part" 2>"$said.log"; then
        mv "$said.part" "$said.json"
    else
        status=$?
        rm -f "$said.part"
        [[ $status -eq 130 ]] && exit 130
        echo "scripts/hidden.sh: campaign $seed was not diagnosed (exit status $status): $(tail -n 1 "$said.log")" >&2
    fi
done
"$hidden" score --answers "$place/answers" --diagnoses "$place/diagnoses" --markdown "$place/score.md"
