#!/usr/bin/env bash
# Builds and runs the verification cases, and writes their page with its pictures: docs/verification.md.
#
#   scripts/verification.sh [CASE...]       runs and reports only these cases; the page is not changed
#
# Exit status: 0 all passed, 1 at least one failed, 2 bad input.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build build/release --target stylobate_verify --parallel "$(nproc)"
verify=build/release/studies/evidence/verification/stylobate_verify
if [[ $# -gt 0 ]]; then
    exec "$verify" "$@"
fi
exec "$verify" --output docs/verification.md
