#!/usr/bin/env bash
# Builds the engine as WebAssembly and the page that runs it: build/web/index.html, one file that needs no server.
# Installs Emscripten (Debian's, about 1 GB with what it needs) if it is missing.
#
#   scripts/web.sh [--site FOLDER]
#
#   --site FOLDER  also copies the page into the site of the documentation (mkdocs build), as FOLDER/web/index.html
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

site=
if [[ ${1:-} == --site && $# -eq 2 ]]; then
    site=$2
elif [[ $# -gt 0 ]]; then
    echo "web.sh: '$1' is not an option. Usage: scripts/web.sh [--site FOLDER]" >&2
    exit 2
fi

command -v em++ >/dev/null || scripts/install_packages.sh emscripten
scripts/install_packages.sh cmake ninja-build libboost1.74-dev librandom123-dev libtomlplusplus-dev libfmt-dev libeigen3-dev

toolchain=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake
if [[ ! -f $toolchain ]]; then
    echo "web.sh: $toolchain is missing; this is for Debian's package of Emscripten." >&2
    exit 1
fi
export NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH} # acorn, for a node that is not Debian's
cmake -S web -B build/web/engine -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$toolchain" >/dev/null
cmake --build build/web/engine --parallel "$(nproc)"

version=$(sed -n 's/^project(stylobate VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
python3 web/assemble.py build/web/engine/stylobate.{js,wasm} build/web/engine/fused.wasm "$version" build/web/index.html
if [[ -n $site ]]; then
    mkdir -p "$site/web"
    cp build/web/index.html "$site/web/index.html"
fi
