#!/usr/bin/env bash
# Makes single mistakes in estimators, intervals, decisions and diagnoses, and counts those that the tests notice:
#
#   scripts/mutants.sh                      all mistakes of tests/mutants/*.txt; writes tests/mutants/README.md
#   scripts/mutants.sh estimators/past      those whose file, line or description matches this regular expression
#   scripts/mutants.sh --list [REGEX]       their numbers and descriptions
#   scripts/mutants.sh --check              verifies the lists, without a build
#   scripts/mutants.sh --quick ...          without the statistical tests, which take minutes each
#   scripts/mutants.sh --keep --jobs 2 ...  keeps the copy and its build, so that the next run is quicker; two at a time
#
# All mistakes are in one copy of the tree (build/mutants/tree, or --tree FOLDER), which is built once (in
# build/mutants/build, or --build FOLDER); the environment variable STYLOBATE_MUTANT=NUMBER chooses the one that is
# made. Exit status 1 where fewer than 90 % of those that were run are noticed.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd -- "$root"
tree=build/mutants/tree build=build/mutants/build jobs=$(nproc) keep="" quick="" action=run regex=""
while [[ $# -gt 0 ]]; do
    case $1 in
    --list | --check) action=${1#--} ;;
    --keep) keep=yes ;;
    --quick) quick=quick ;;
    --jobs | --tree | --build)
        [[ $# -gt 1 ]] || { echo "mutants.sh: $1 needs a value" >&2; exit 2; }
        printf -v "${1#--}" %s "$2"
        shift
        ;;
    -*) sed -n '2,14s/^# \?//p' "$0" >&2; exit 2 ;;
    *) regex=$1 ;;
    esac
    shift
done

mutants() { python3 scripts/mutants.py "$@"; }
mutants check
case $action in
list) mutants list "$regex"; exit ;;
check) exit ;;
esac

mutants copy "$tree" "$regex"
[[ -f $build/CMakeCache.txt ]] ||
    cmake -S "$tree" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTYLOBATE_BENCH=OFF -DSTYLOBATE_INSTALL=OFF \
        -DSTYLOBATE_CUDA=OFF -DSTYLOBATE_PYTHON=OFF >/dev/null
mapfile -t programs < <(mutants programs "$regex")
cmake --build "$build" --target "${programs[@]}" --parallel "$jobs"
status=0
mutants run "$build" "$jobs" "$regex" "$quick" || status=$?
[[ -n $keep ]] || rm -rf "$tree" "$build"
exit $status
