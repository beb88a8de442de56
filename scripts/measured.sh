#!/usr/bin/env bash
# Compares the engine with real measured data and writes docs/measured/*.md with their pictures.
#
#   scripts/measured.sh [--case NAME] [--threads N]     one page alone; any option of stylobate_measured
# DATA=DIR: folder of the measured data; a page whose data are absent is skipped with a message and not changed.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

data=${DATA:-../shared/data}
if [[ ! -d $data ]]; then
    echo "measured.sh: skipped, there is no folder $data (set DATA to the folder of the measured data)"
    exit 0
fi
cmake --preset release >/dev/null
cmake --build build/release --target stylobate_measured --parallel "$(nproc)"
build/release/studies/evidence/measured/stylobate_measured "$data" --output docs/measured --studies studies/evidence/measured/fitted "$@"
