#!/usr/bin/env bash
# Installs general engines of rigid bodies, builds the comparison with them and runs its tests. Each test writes its
# results and the same as tables:
#
#   rocking       bench/results/peers-PROCESSOR.json, .md                 tens of minutes
#   restitution   bench/results/peers-PROCESSOR-restitution.json, .md     minutes
#   collapse      bench/results/peers-PROCESSOR-collapse.json, .md        tens of minutes, on all cores
#   spatial       bench/results/peers-PROCESSOR-spatial.json, .md         minutes: drums in space
#
#   scripts/bench_peers.sh                                   all of them
#   scripts/bench_peers.sh --only TEST                       one of them
#   scripts/bench_peers.sh --test collapse --budget 120 --draws 2048     a trial: with any option of bench/peers/peers
#                                                            the results go to the terminal alone
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
tests=(rocking restitution collapse spatial)
if [[ ${1:-} == --help || ${1:-} == -h ]]; then # before anything is installed
    sed -n '2,/^set/s/^# \{0,1\}//p' scripts/bench_peers.sh | sed 's/^#$//'
    exit 0
fi
if [[ ${1:-} == --only ]]; then
    if [[ $# -ne 2 || " ${tests[*]} " != *" $2 "* ]]; then
        echo "scripts/bench_peers.sh: --only takes one of: ${tests[*]}" >&2
        exit 2
    fi
    tests=("$2")
    shift 2
fi
scripts/install_packages.sh
scripts/install_peers.sh
cmake --preset release -DSTYLOBATE_PEERS=ON >/dev/null
cmake --build build/release --target peers --parallel "$(nproc)"
peers=build/release/bench/peers/peers
[[ $# -eq 0 ]] || exec "$peers" "$@"

processor=$("$peers" --processor | tr -cs 'A-Za-z0-9.\n' '-' | sed 's/^-*//; s/-*$//')
mkdir -p bench/results
for test in "${tests[@]}"; do
    out=bench/results/peers-$processor
    [[ $test == rocking ]] || out+=-$test
    options=(--test "$test")
    [[ $test != collapse ]] || options+=(--processes "$(nproc)")
    new=$(mktemp -d "$out.XXXXXX")
    trap 'rm -rf "$new"' EXIT
    "$peers" "${options[@]}" --json "$new/json" --markdown "$new/md"
    mv "$new/json" "$out.json"
    mv "$new/md" "$out.md"
    rm -r "$new"
    echo "$out.json"
done
