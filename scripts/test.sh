#!/usr/bin/env bash
# Builds the program and its tests, and runs these. The programs that measure are built with --long.
#
#   scripts/test.sh [--long] [--debug | --asan | --tsan] [-- CTEST ARGUMENTS]
#
#   --long     also the tests labelled `long`, and the target `measurements`
#   --debug    with assertions; --asan, --tsan: with sanitizers
# The last lines are CTest's summary, the exit status is CTest's.
set -euo pipefail

preset=release
selection=(--label-exclude long)
while [[ $# -gt 0 ]]; do
    case $1 in
    --long) selection=() ;;
    --debug | --asan | --tsan) preset=${1#--} ;;
    --)
        shift
        break
        ;;
    *)
        echo "test.sh: '$1' is not an option. Usage: scripts/test.sh [--long] [--debug | --asan | --tsan] [-- CTEST ARGUMENTS]" >&2
        exit 2
        ;;
    esac
    shift
done

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh --tests
targets=(all)
if [[ ${#selection[@]} -eq 0 ]]; then # packages in a bare Debian, and on an old processor
    targets+=(measurements)
    scripts/install_packages.sh debootstrap dpkg-dev file lintian patchelf qemu-user-static
fi
cmake --preset "$preset" >/dev/null
cmake --build "build/$preset" --target "${targets[@]}" --parallel "$(nproc)"
export TSAN_OPTIONS="suppressions=$PWD/tests/tsan_suppressions.txt ${TSAN_OPTIONS:-}"
exec ctest --preset "$preset" --parallel "$(nproc)" "${selection[@]}" "$@"
