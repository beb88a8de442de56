#!/usr/bin/env bash
# Measures what each convention of a study changes in one collapse probability, and writes the table into
# docs/sensitivity.md.
#
#   scripts/conventions.sh [DRAWS]    realizations of each row (default 8192: two minutes)
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
. scripts/built.sh stylobate_conventions

"$build/bench/stylobate_conventions" --draws "${1:-8192}" | scripts/into_page.sh conventions.sh docs/sensitivity.md
