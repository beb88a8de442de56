#!/usr/bin/env bash
# Measures the gain of adaptive surfaces and the coverage of their intervals, and writes the tables into docs/adaptive.md.
#
#   scripts/adaptive.sh [SEEDS [REPEATS]]    adaptive runs of the study itself with that many seeds (default 4), and that
#                                            many simulated runs of each known surface (default 40)
#
# Results are kept in results/adaptive and used again. The reference (±0.02 in every cell, from each cell's own trials)
# takes minutes.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
seeds=${1:-4}
repeats=${2:-40}
. scripts/built.sh stylobate stylobate_adaptive
study=studies/inputs/small_scale_column_adaptive.toml
out=results/adaptive
mkdir -p "$out"

# A finished result is kept, an unfinished one is continued.
run() {
    local file=$1
    shift
    [[ -e $file.done ]] || { "$build/studies/stylobate" run "$study" -o "$file" "$@" && touch "$file.done"; }
}

run "$out/reference.h5" --set study.seed=1001 --set study.realizations=4096 \
    --set 'surface.adaptive={budget=400000,half_width=0.02,minimum=32,borrow=false}'
runs=() sobol=()
for ((seed = 1; seed <= seeds; ++seed)); do
    run "$out/adaptive_$seed.h5" --set "study.seed=$seed"
    runs+=("$out/adaptive_$seed.h5")
    # all cells alike: as many as the budget holds in the first round
    run "$out/sobol_$seed.h5" --set "study.seed=$((2000 + seed))" --set study.sampling=sobol --set study.realizations=32 \
        --set 'surface.adaptive={budget=8192,minimum=32,half_width=0.01,borrow=false}'
    sobol+=("$out/sobol_$seed.h5")
done

"$build/bench/stylobate_adaptive" --reference "$out/reference.h5" --run "${runs[@]}" --sobol "${sobol[@]}" --repeats "$repeats" |
    scripts/into_page.sh adaptive.sh docs/adaptive.md
