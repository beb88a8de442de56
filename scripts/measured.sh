#!/usr/bin/env bash
# Sets the engine against real measured data and writes docs/measured/*.md with their pictures.
#
#   scripts/measured.sh [--case NAME] [--threads N]     one page alone; any option of stylobate_measured
# DATA=DIR: where the measured data lie; a page whose data are absent is skipped with a message and stays as it is.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

data=${DATA:-../shared/data}
if [[ ! -d $data ]]; then
    echo "measured.sh: skipped, there is no folder $data (set DATA to where the measured data lie)"
    exit 0
fi
cmake --preset release >/dev/null
cmake --build build/release --target stylobate_measured --parallel "$(nproc)"
build/release/studies/evidence/measured/stylobate_measured "$data" --output docs/measured --studies studies/evidence/measured/fitted "$@"
