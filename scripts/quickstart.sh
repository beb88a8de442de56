#!/usr/bin/env bash
# From a fresh clone on Debian 12 to the probability of collapse of a seven-drum column over frequency and PGA.
# Installs the packages, builds, computes and draws; an interrupted run is continued.
#
#   scripts/quickstart.sh
#   scripts/quickstart.sh --set study.realizations=4     a trial: arguments go to `stylobate run`, and the results
#                                                        replace those of the trial before
set -euo pipefail

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
    sed -n '2,/^set /{s/^# \{0,1\}//;/^set /d;p}' "${BASH_SOURCE[0]}"
    exit
fi

stage="finding the project"
report() {
    local status=$?
    [[ $status -eq 0 || $status -eq 130 ]] || echo "quickstart.sh: $stage failed, see above." >&2
}
trap report EXIT

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
root=$PWD
study=studies/inputs/small_scale_column.toml
name=results/small_scale_column
[[ $# -eq 0 ]] || name+=_trial
stylobate=build/release/studies/stylobate

stage="installing the packages"
scripts/install_packages.sh

stage="building"
cmake --preset release >/dev/null
cmake --build build/release --target stylobate --parallel "$(nproc)"

stage="running $study"
mkdir -p results
[[ $# -eq 0 ]] || rm -f "$name.h5"
"$stylobate" run "$study" -o "$name.h5" "$@"
stage="drawing the picture"
"$stylobate" export "$name.h5" -o "$name.png" --force --quiet >/dev/null

cat <<TEXT

The picture, probability of collapse over frequency and PGA:
  $root/$name.png

What to try next, in $root:
  your own study     cp $study my_column.toml, change it,
                     $stylobate run my_column.toml -o my_column.h5
                     $stylobate export my_column.h5 --to png
  other values       $stylobate run $study -o stiff.h5 --set contact.normal_stiffness_n_m2=1e9
  an earthquake      $stylobate record FILE.AT2
                     $stylobate run studies/inputs/record.toml -o quake.h5 --set excitation.file=FILE.AT2
  one realization    $stylobate replay $name.h5 --realization 100 -o one.h5
                     $stylobate export one.h5 --to png
TEXT
