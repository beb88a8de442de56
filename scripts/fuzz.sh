#!/bin/sh
# Fuzzes the readers of ground motions with libFuzzer and its sanitizers: scripts/fuzz.sh [INPUTS|SECONDSs [FOLDER]]
#
#   scripts/fuzz.sh           a million inputs, built in build-fuzz
#   scripts/fuzz.sh 60s       as many as a minute allows
#
# Needs clang++. A finding is kept as FOLDER/finding-*; run the target with it
# as its only argument to reproduce it. New inputs are kept in FOLDER/found, and a
# later run continues from them.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
case ${1:-1000000} in
*s) limit=-max_total_time=${1%s} ;;
*) limit=-runs=${1:-1000000} ;;
esac
build=${2:-"$source/build-fuzz"}
cmake -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="${CXX:-clang++}" \
      -DCMAKE_C_COMPILER="${CC:-clang}" -DSTYLOBATE_FUZZ=ON -DSTYLOBATE_BENCH=OFF -DSTYLOBATE_CUDA=OFF
cmake --build "$build" --target fuzz_record
mkdir -p "$build/found"
"$build/tests/fuzz_record" "$limit" -max_len=4096 -artifact_prefix="$build/finding-" -print_final_stats=1 \
    "$build/found" "$source/tests/io/records/corpus/record"
