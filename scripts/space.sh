#!/usr/bin/env bash
# Runs one column in the plane and in space, and writes what the plane leaves out into docs/space.md and, its principal
# rows, into README.md.
#
#   scripts/space.sh [REALIZATIONS]     of each PGA (2000: about an hour on two cores)
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
root=$PWD
. scripts/built.sh stylobate
stylobate=$(realpath "$build/studies/stylobate")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 scripts/space.py "$stylobate" "$work" "${1:-2000}" >"$work/table.md"
"$root/scripts/into_page.sh" space.sh docs/space.md <"$work/table.md"
grep -E '^\|(---| column and| in the plane, along x \|| round, in space)' "$work/table.md" |
    "$root/scripts/into_page.sh" space.sh README.md
