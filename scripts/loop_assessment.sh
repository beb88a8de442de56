#!/bin/bash
# Assesses the laboratory in the loop on virtual specimens (docs/diagnosis_assessments.md): 60 with one effect, 40 with
# nothing, 20 with an effect outside the list; and twelve columns of three blocks with two effects each.
#
#   scripts/loop_assessment.sh FOLDER [flat|group|pairs] [BUILD]   the folder keeps what is simulated and a table for each
#                                                                  part; a part that is there is not made again
#   scripts/loop_assessment.sh first [ONE NOTHING OUTSIDE]         the first diagnosis instead, of shake runs of the same
#                                                                  specimens: of the first so many of each part
#                                                                  (scripts/hidden.sh; minutes for each)
set -euo pipefail
out=${1:?folder}; prior=${2:-flat}; build=${3:-build/release}
cmake --build "$build" --target loop_assessment hidden_campaigns --parallel "$(nproc)"
listed=(stribeck joint_friction friction_wear dowel adhesion bond corner_loss eccentricity wedge rate_damping face_damping drag)
outside=(heat_memory coriolis magnet direction draught patch slosh spin)
if [[ $out == first ]]; then
    counts=("${2:-60}" "${3:-40}" "${4:-20}") firsts=(81001 82001 83001)
    for i in 0 1 2; do
        ((counts[i] > 0)) || continue
        seeds=${firsts[i]}..$((firsts[i] + counts[i] - 1))
        for ((k = 0; k < counts[i]; ++k)); do
            hidden=(--nothing)
            ((i != 0)) || hidden=(--effect "${listed[k % ${#listed[@]}]}")
            ((i != 2)) || hidden=(--effect "${outside[k % ${#outside[@]}]}")
            build/release/tests/hidden/hidden_campaigns generate --specimen column "${hidden[@]}" --seeds $((firsts[i] + k)) \
                --out "results/hidden/$seeds"
        done
        scripts/hidden.sh "$seeds"
    done
    exit
fi
program=$(realpath "$build/tests/hidden/loop_assessment")
mkdir -p "$out"
part() { # name, then options
    local table=$out/${prior}_$1.txt
    shift
    [[ -e $table ]] && return
    "$program" --specimen column --prior "$prior" --cache "$out/cache" "$@" > "$table.part"
    mv "$table.part" "$table"
}
# flags of the effects for CLI11: one --effect each
effects() { local e; for e in "$@"; do printf -- '--effect %s ' "$e"; done; }
if [[ $prior == pairs ]]; then # every test, because a name ends the sequence
    # shellcheck disable=SC2046
    prior=flat part pairs --first 84001 --last 84060 --blocks 3 --most 12 --in-turn --second 5 $(effects "${listed[@]}") \
        --tests 7 $(printf -- '--order %s ' rest slide board pull drop push tilt)
    cut -f 4,5,15 "$out/flat_pairs.txt" | grep -v '^#'
    exit
fi
# shellcheck disable=SC2046
part one --first 81001 --last 81060 --in-turn $(effects "${listed[@]}")
if [[ $prior != group ]]; then # the right group is that of a listed effect
    part nothing --first 82001 --last 82040 --nothing
    # shellcheck disable=SC2046
    part outside --first 83001 --last 83020 --in-turn $(effects "${outside[@]}")
fi
for name in one nothing outside; do
    [[ -e $out/${prior}_$name.txt ]] || continue
    echo "$prior, $name:"
    grep -v '^#' "$out/${prior}_$name.txt" | cut -f 15 | sort | uniq -c
done
