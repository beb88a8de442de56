# To be sourced by scripts that write pages, in the project's folder: builds targets and sets `build`, the folder in which
# they are. With STYLOBATE_BUILD set nothing is installed or built: it names the folder.
#
#   . scripts/built.sh TARGET...
build=${STYLOBATE_BUILD:-build/release}
if [[ -z ${STYLOBATE_BUILD:-} ]]; then
    scripts/install_packages.sh
    cmake --preset release >/dev/null
    cmake --build "$build" --target "$@" --parallel "$(nproc)"
fi
