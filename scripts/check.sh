#!/usr/bin/env bash
# Gates before a change is merged: checks that the build and the tests do not cover, or cover late.
#
#   scripts/check.sh [--within SECONDS] [GATE...]       all of them, or some:
#
#   format     clang-format has nothing to change
#   headers    every header compiles by itself, with clang's warnings as errors
#   clang      so does every source file
#   bench      so does every source file of the programs that measure, by the compiler and with the warnings of the release
#              build, which leaves these programs out
#   tidy       clang-tidy finds nothing in the files that changed last, and then in as many others as TIDY_S seconds
#              (300) allow; TIDY_S=0: in all files
#   sanitize   the tests of files and numerics (SANITIZE: the programs, "inputs estimators") under AddressSanitizer and
#              UndefinedBehaviorSanitizer
#   fuzz       a minute (FUZZ_S) of malformed files, shared by all readers
#
# --within: a gate that has not begun after that many seconds is left out, with a line that states it (CI has 40 minutes for
# all it does, on machines of several speeds). Exit status 1 if a gate is closed; its findings stand above the last line.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh --tests
scripts/install_packages.sh clang clang-format clang-tidy libclang-rt-14-dev
jobs=$(nproc)
work=build/check
mkdir -p "$work"

# The commands of clang for every source file, without building anything.
configure() {
    [[ -z ${configured:-} ]] || return 0
    cmake -S . -B "$work/clang" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
        -DCMAKE_C_COMPILER=clang -DSTYLOBATE_WERROR=ON -DSTYLOBATE_CUDA=OFF -DSTYLOBATE_UNITY=OFF \
        -DCMAKE_CXX_COMPILER_LAUNCHER= -DCMAKE_C_COMPILER_LAUNCHER= >"$work/configure.log" || { cat "$work/configure.log"; return 1; }
    ninja -C "$work/clang" stylobate_precompiled stylobate_tests_headers >"$work/configure.log" || { cat "$work/configure.log"; return 1; }
    configured=yes
}

sources() { git ls-files --cached --others --exclude-standard -- "$@"; }

# Runs commands from standard input, a line each, in parallel; fails if one does.
in_parallel() { xargs -P "$jobs" -d '\n' -I{} bash -c '{}'; }

gate_format() { sources '*.cpp' '*.hpp' '*.cu' '*.cuh' | xargs -P "$jobs" -n 40 clang-format --dry-run --Werror; }

# syntax BUILD TARGET...: the commands that check the source files of these targets without compiling them.
syntax() {
    local build=$1
    shift
    ninja -C "$build" -t commands "$@" | grep -- ' -c ' | grep -vE 'version.cpp|page_assets.cpp|cmake_pch.hxx.cxx' |
        sed -E "s| -o [^ ]+||; s| -M[DTF]+( [^ ]+\.(o\|d))?||g; s|^|cd $build \&\& |; s|\$| -fsyntax-only|"
}

gate_clang() {
    configure
    syntax "$work/clang" all measurements | in_parallel
}

gate_bench() {
    cmake --preset release >/dev/null
    syntax build/release measurements | grep -vxFf <(syntax build/release all) | in_parallel
}

gate_headers() {
    local flags=(-std=c++20 -fsyntax-only -x c++ -I. -Iinclude -isystem /usr/include/eigen3 -isystem /usr/include/hdf5/serial
        -isystem /usr/include/python3.11
        -DFMT_SHARED '-DSTYLOBATE_SOURCE_DIR=""' '-DSTYLOBATE_DATA_DIR=""' '-DSTYLOBATE_PROGRAM=""' -mavx2 -mfma
        -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wcast-align -Wconversion -Werror
        -Wno-pragma-once-outside-header -Wno-unused-const-variable -Wno-unused-function)
    sources '*.hpp' | grep -vE '^bench/peers/|^web/' | xargs -P "$jobs" -n 1 clang++ "${flags[@]}"
}

gate_tidy() {
    configure
    local until=$((SECONDS + ${TIDY_S:-300})) checked=0 total part found=0
    # those that changed last first
    mapfile -t files < <({
        git diff --name-only HEAD -- '*.cpp'
        git log -n 200 --name-only --format= -- '*.cpp'
        sources '*.cpp'
    } | awk '!seen[$0]++' | grep -vE '^bench/peers/|^web/|^tests/bench/test_peers|^examples/|^tests/fuzz/fuzzer' | while read -r file; do
        [[ -f $file ]] && echo "$file"
    done)
    total=${#files[@]}
    while ((checked < total)) && ((SECONDS < until || ${TIDY_S:-300} == 0)); do
        part=("${files[@]:checked:4*jobs}")
        printf '%s\n' "${part[@]}" |
            xargs -P "$jobs" -n 1 clang-tidy -p "$work/clang" --quiet --warnings-as-errors='*' 2>"$work/tidy.log" || found=1
        checked=$((checked + ${#part[@]}))
    done
    echo "tidy: $checked of $total files"
    return $found
}

gate_sanitize() {
    cmake --preset asan >/dev/null
    local programs=${SANITIZE:-inputs estimators}
    cmake --build build/asan --target $(printf 'test_%s ' $programs) --parallel "$jobs"
    ctest --preset asan --parallel "$jobs" --label-exclude long --tests-regex "^(${programs// /|})\\." --output-on-failure --quiet
}

gate_fuzz() { scripts/fuzz.sh all "$((${FUZZ_S:-60} / 7))s" "$work/fuzz" 2>&1 | tail -n 40; }

all=(format headers bench clang tidy sanitize fuzz)
within=
if [[ ${1:-} == --within ]]; then
    within=${2:?check.sh: --within needs a number of seconds}
    shift 2
fi
gates=("$@")
[[ $# -gt 0 ]] || gates=("${all[@]}")
for gate in "${gates[@]}"; do
    [[ " ${all[*]} " == *" $gate "* ]] || { echo "check.sh: '$gate' is not a gate. Gates: ${all[*]}" >&2; exit 2; }
done
closed=()
for gate in "${gates[@]}"; do
    begin=$SECONDS
    if [[ -n $within ]] && ((begin >= within)); then
        echo "check.sh: $gate skipped, $begin s of $within have passed"
        continue
    fi
    set +e # a function in a condition would run on after an error
    (
        set -e
        "gate_$gate"
    )
    status=$?
    set -e
    if [[ $status -eq 0 ]]; then
        echo "check.sh: $gate passed, $((SECONDS - begin)) s"
    else
        closed+=("$gate")
        echo "check.sh: $gate FAILED, see above" >&2
    fi
done
[[ ${#closed[@]} -eq 0 ]] || { echo "check.sh: failed gates: ${closed[*]}" >&2; exit 1; }
