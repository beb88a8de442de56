#!/usr/bin/env bash
# Installs the Debian 12 packages that Stylobate is built from, run and tested with: the one list of them.
# Does nothing if all are installed; needs the rights of apt only.
#
#   scripts/install_packages.sh [--tests | PACKAGE...]
#
#   --tests    also what only the tests and the Python module need; PACKAGE...: these instead of the list
set -euo pipefail

packages=(
    g++ cmake ninja-build git                           # build; git gives the version
    libxsimd-dev libtbb-dev libeigen3-dev               # registers, threads, linear algebra
    libboost1.74-dev librandom123-dev                   # distributions, random numbers (headers only)
    libhdf5-dev zlib1g-dev libtomlplusplus-dev          # result and study files
    libcli11-dev libfmt-dev                             # command line, text
    libpugixml-dev                                      # fragility functions in NRML
    librsvg2-dev pkgconf fonts-dejavu-core              # pictures as PNG and PDF
    libgtest-dev libbenchmark-dev python3-jsonschema    # tests, benchmarks
    nlohmann-json3-dev                                  # what tests read of what the program prints
)
for_tests=(
    pybind11-dev python3-dev python3-numpy              # the Python module
    python3-pytest python3-pandas python3-xarray        # its tests, and those of labels in results files
    python3-h5netcdf python3-matplotlib python3-pil
    python3-nbclient python3-nbformat python3-ipykernel # its example notebook, run by Jupyter
    chromium python3-h5py                               # pages of reports in a browser
    mkdocs mkdocs-material                              # the site of docs/
    libopenmpi-dev openmpi-bin iproute2                 # several processes (`run --mpi`), on several hosts
    groff python3-jinja2 python3-yaml                   # the manual page, recipes of packages
)
if [[ ${1:-} == --tests ]]; then
    packages+=("${for_tests[@]}")
elif [[ $# -gt 0 ]]; then
    packages=("$@")
fi

missing=()
for package in "${packages[@]}"; do
    state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $state == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

fail() {
    echo "install_packages.sh: $1 Needed: ${missing[*]}" >&2
    exit 1
}

command -v apt-get >/dev/null || fail "there is no apt-get; this is for Debian 12."
as_root=()
if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null || fail "not root, and there is no sudo."
    as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120)

echo "Installing ${missing[*]}"
"${apt[@]}" update || echo "install_packages.sh: apt-get update failed; continuing with the existing lists" >&2
"${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >/dev/null || fail "apt-get install failed, see above."
