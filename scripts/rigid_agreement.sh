#!/usr/bin/env bash
# Writes into docs/rigid_limit.md what its first table shows of the agreement with rigid blocks; nothing is simulated.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
. scripts/built.sh stylobate_rigid_limit

"$build/bench/stylobate_rigid_limit" --agreement docs/rigid_limit.md |
    scripts/into_page.sh rigid_agreement.sh docs/rigid_limit.md
