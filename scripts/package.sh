#!/usr/bin/env bash
# Makes the packages for Debian 12: the program, the library, the Python module and the pages, and checks them by lintian.
# Or a wheel: the Python module and the program with all libraries that they need, for any Linux with Python 3.11, NumPy
# and a C library that is no older than this machine's.
#
#   scripts/package.sh [FOLDER]                    into FOLDER (default: build/packages)
#   sudo apt install ./build/packages/stylobate_*.deb
#
#   scripts/package.sh --wheel [FOLDER]
#   pip install --no-index build/packages/stylobate-*.whl
#
# STYLOBATE_BUILD: a build folder that is there and built; default build/release, which is configured and built. A build
# with the GPU backend is refused: Debian has nothing that the packages could depend on, and no wheel was tried with it.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
kind=deb
if [[ ${1:-} == --wheel ]]; then
    kind=whl
    shift
fi
if [[ ${1:-} == -* || $# -gt 1 ]]; then
    sed -n '2,/^set/s/^# \{0,1\}//p' scripts/package.sh
    [[ ${1:-} =~ ^(--help|-h)$ && $# -eq 1 ]] && exit 0 || exit 2
fi
out=$(realpath -m -- "${1:-build/packages}")
build=${STYLOBATE_BUILD:-build/release}
if [[ -z ${STYLOBATE_BUILD:-} ]]; then
    scripts/install_packages.sh
    scripts/install_packages.sh pybind11-dev python3-dev python3-numpy
    cmake --preset release >/dev/null
    cmake --build "$build" --target stylobate stylobate_library stylobate_python --parallel "$(nproc)"
fi
if grep -q '^CMAKE_CUDA_COMPILER:' "$build/CMakeCache.txt"; then
    echo "package.sh: $build has the GPU backend, for which no packages are made." >&2
    echo "  Configure another folder with -DSTYLOBATE_CUDA=OFF, build it, and name it in STYLOBATE_BUILD." >&2
    exit 2
fi

# the same sources give the same bytes
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH
umask 022
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [[ $kind == whl ]]; then
    scripts/install_packages.sh patchelf
    grep -q '^STYLOBATE_STATIC_HDF5:FILEPATH=/' "$build/CMakeCache.txt" || {
        echo "package.sh: $build has no Python module, or the static HDF5 that a wheel contains is missing." >&2
        echo "  apt install libhdf5-dev pybind11-dev python3-dev, and configure the build again (cmake $build)." >&2
        exit 2
    }
    python=$(sed -n 's/^_Python_EXECUTABLE:INTERNAL=//p' "$build/CMakeCache.txt")
    "$python" python/build_backend.py "$work" "$build" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        exit 1
    }
else
    scripts/install_packages.sh dpkg-dev file lintian
    cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        exit 1
    }
    lintian --fail-on error --tag-display-limit 0 "$work"/*.deb
fi
mkdir -p "$out"
rm -f "$out"/*."$kind"
mv "$work"/*."$kind" "$out"
for package in "$out"/*."$kind"; do
    if [[ $kind == whl ]]; then
        installed=$("$python" -m zipfile -l "$package" | awk 'NR > 1 { sum += $NF } END { print int(sum / 1024) }')
    else
        installed=$(dpkg-deb --field "$package" Installed-Size)
    fi
    printf '%7d kB, installed %7d kB  %s\n' $(($(stat -c %s "$package") / 1000)) "$installed" "$package"
done
