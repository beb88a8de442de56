#!/usr/bin/env bash
# Installs general engines of rigid bodies, builds the comparison with them, runs it, and writes
# bench/results/peers-PROCESSOR.json and the same as a table beside it (.md). A quarter of an hour on one core.
#
#   scripts/bench_peers.sh [--engine NAME] [--seconds 1]      a trial: with any option of bench/peers/peers the
#                                                             results go to the terminal alone
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh
scripts/install_peers.sh
cmake --preset release -DSTYLOBATE_PEERS=ON >/dev/null
cmake --build build/release --target peers --parallel "$(nproc)"
peers=build/release/bench/peers/peers
[[ $# -eq 0 ]] || exec "$peers" "$@"

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1 | tr -cs 'A-Za-z0-9.\n' '-' | sed 's/^-*//; s/-*$//')
out=bench/results/peers-${processor:-unknown}
mkdir -p bench/results
new=$(mktemp -d "$out.XXXXXX")
trap 'rm -rf "$new"' EXIT
"$peers" --json "$new/json" --markdown "$new/md"
mv "$new/json" "$out.json"
mv "$new/md" "$out.md"
echo "$out.json"
