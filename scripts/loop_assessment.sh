#!/bin/bash
# Assesses the laboratory in the loop on virtual specimens (docs/diagnosis_assessments.md): 60 with one effect, 40 with
# nothing, 20 with an effect outside the list. Usage: scripts/loop_assessment.sh FOLDER [flat|group] [BUILD]
# The folder keeps what is simulated and a table for each part; a part that is there is not made again.
set -euo pipefail
out=${1:?folder}; prior=${2:-flat}; build=${3:-build/release}
program=$(realpath "$build/tests/hidden/loop_assessment")
mkdir -p "$out"
listed=(stribeck joint_friction friction_wear dowel adhesion bond corner_loss eccentricity wedge rate_damping face_damping drag)
outside=(heat_memory coriolis magnet direction draught patch slosh spin)
part() { # name, then options
    local table=$out/${prior}_$1.txt
    shift
    [[ -e $table ]] && return
    "$program" --specimen column --prior "$prior" --cache "$out/cache" "$@" > "$table.part"
    mv "$table.part" "$table"
}
# flags of the effects for CLI11: one --effect each
effects() { local e; for e in "$@"; do printf -- '--effect %s ' "$e"; done; }
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
