#!/usr/bin/env bash
# Compares the speed of this tree with that of another commit: builds both, runs their benchmarks alternately, and reports
# faster, slower, the same, or undecided, each with its interval. Exit status 1 if a benchmark has become slower.
#
#   scripts/speed_guard.sh [COMMIT [OPTION...]]      COMMIT: HEAD by default (changes not committed yet against it);
#                                                    options of build/release/bench/speed_guard: --pairs 15, --filter
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
commit=$(git rev-parse --verify --short "${1:-HEAD}^{commit}")
[[ $# -eq 0 ]] || shift
scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build build/release --target stylobate_bench speed_guard --parallel "$(nproc)"

tree=build/before/$commit
if [[ ! -x $tree/build/release/bench/stylobate_bench ]]; then
    rm -rf "$tree"
    git worktree prune
    git worktree add --detach "$tree" "$commit" >/dev/null
    (cd "$tree" && cmake --preset release >/dev/null &&
        cmake --build build/release --target stylobate_bench --parallel "$(nproc)")
fi
echo "before: $commit; after: this tree"
exec build/release/bench/speed_guard "$tree/build/release/bench/stylobate_bench" build/release/bench/stylobate_bench "$@"
