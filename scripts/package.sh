#!/usr/bin/env bash
# Makes the packages for Debian 12: the program, the library, the Python module and the pages, and checks them by lintian.
#
#   scripts/package.sh [FOLDER]                    into FOLDER (default: build/packages)
#   sudo apt install ./build/packages/stylobate_*.deb
#
# STYLOBATE_BUILD: a build folder that is there and built; default build/release, which is configured and built. A build
# with the GPU backend is refused: Debian has nothing that the packages could depend on.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
if [[ ${1:-} == --help || ${1:-} == -h || $# -gt 1 ]]; then
    sed -n '2,/^set/s/^# \{0,1\}//p' scripts/package.sh | sed '$d'
    [[ $# -le 1 ]] && exit 0 || exit 2
fi
out=$(realpath -m -- "${1:-build/packages}")
build=${STYLOBATE_BUILD:-build/release}
if [[ -z ${STYLOBATE_BUILD:-} ]]; then
    scripts/install_packages.sh
    scripts/install_packages.sh pybind11-dev python3-dev python3-numpy
    cmake --preset release >/dev/null
    cmake --build "$build" --target stylobate stylobate_library stylobate_python --parallel "$(nproc)"
fi
scripts/install_packages.sh dpkg-dev file lintian
if grep -q '^CMAKE_CUDA_COMPILER:' "$build/CMakeCache.txt"; then
    echo "package.sh: $build has the GPU backend, which a package for Debian cannot depend on." >&2
    echo "  Configure another folder with -DSTYLOBATE_CUDA=OFF, build it, and name it in STYLOBATE_BUILD." >&2
    exit 2
fi

# the same sources give the same bytes
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH
umask 022
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || {
    cat "$work/log" >&2
    exit 1
}
lintian --fail-on error --tag-display-limit 0 "$work"/*.deb
mkdir -p "$out"
rm -f "$out"/*.deb
mv "$work"/*.deb "$out"
for package in "$out"/*.deb; do
    printf '%7d kB, installed %7d kB  %s\n' $(($(stat -c %s "$package") / 1000)) \
        "$(dpkg-deb --field "$package" Installed-Size)" "$package"
done
