#!/usr/bin/env bash
# Coverage of the friction intervals of `stylobate calibrate`: virtual campaigns of
# fresh seeds (tests/hidden), under two contact laws that the engine does not have, whose true friction is 0.4 to 1.2 of
# the nominal one. An interrupted run continues: existing campaigns and calibrations are reused.
#
#   scripts/calibration.sh A..B C..D     seeds A to B under the law `nonsmooth`, C to D under `compliant`
#
# The other contact parameters are fixed: only the friction is evaluated. The table goes to the terminal and to
# results/calibration/A..B_C..D/coverage.md. Exit status: that of the table; a failed calibration is reported, its message
# is in calibrations/SEED.log, and its campaign is not counted.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

if [[ $# -ne 2 || ! $1 =~ ^[0-9]+\.\.[0-9]+$ || ! $2 =~ ^[0-9]+\.\.[0-9]+$ ]]; then
    echo "scripts/calibration.sh: give the seeds of both laws as A..B C..D, for example 1000..1119 2000..2119" >&2
    exit 2
fi

cmake --preset release >/dev/null
cmake --build build/release --target stylobate hidden_campaigns --parallel "$(nproc)"
hidden=build/release/tests/hidden/hidden_campaigns
stylobate=build/release/studies/stylobate

place=results/calibration/$1_$2
mkdir -p "$place/calibrations"
"$hidden" generate --seeds "$1" --law nonsmooth --nothing --friction 0.4 1.2 --out "$place"
"$hidden" generate --seeds "$2" --law compliant --nothing --friction 0.4 1.2 --out "$place"
for answer in "$place"/answers/*.toml; do
    seed=$(basename "$answer" .toml)
    said=$place/calibrations/$seed
    [[ -e $said.json ]] && continue
    rm -f "$said.h5" "${said}_calibrated.toml"
    if "$stylobate" calibrate "$place/campaign_$seed.h5" -o "$said.h5" --no-held-out \
        --hold contact.normal_stiffness_n_m2 --hold contact.tangential_stiffness_n_m \
        --hold contact.normal_damping_ratio --hold contact.tangential_damping_ratio \
        --quiet --json >"$said.part" 2>"$said.log"; then
        mv "$said.part" "$said.json"
        rm -f "$said.h5" "${said}_calibrated.toml" "$said.log"
    else
        status=$?
        rm -f "$said.part"
        [[ $status -eq 130 ]] && exit 130
        echo "scripts/calibration.sh: campaign $seed was not calibrated (exit status $status): $(tail -n 1 "$said.log")" >&2
    fi
done
"$hidden" coverage --answers "$place/answers" --calibrations "$place/calibrations" --markdown "$place/coverage.md"
