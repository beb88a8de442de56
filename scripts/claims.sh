#!/usr/bin/env bash
# Tests the paper's claims (studies/evidence/paper) and writes docs/claims.md with its pictures. An interrupted run
# continues; complete results in results/claims are reused.
#
#   scripts/claims.sh                                     all of them: tens of minutes
#   scripts/claims.sh --only P1,P2 --realizations 20      a trial: any option of stylobate_claims; it writes
#                                                         results/claims_trial/claims.md and does not change docs
# RECORDS=DIR: folder of the earthquake records; without it, the claims on earthquakes are "not run".
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

cmake --preset release >/dev/null
cmake --build build/release --target stylobate_claims --parallel "$(nproc)"

place=(--results results/claims --page docs/claims.md --images docs/images/claims)
for option in "$@"; do
    case $option in
    --only* | --realizations*)
        place=(--results results/claims_trial --page results/claims_trial/claims.md --images results/claims_trial/images)
        ;;
    esac
done
build/release/studies/evidence/claims/stylobate_claims studies/evidence/paper/*.toml --data "${RECORDS:-../shared/data/records}" \
    "${place[@]}" "$@"
