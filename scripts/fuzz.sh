#!/usr/bin/env bash
# Fuzzes the readers of files with libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer (tests/fuzz/README.md):
#
#   scripts/fuzz.sh [--keep] all|TARGET [INPUTS|SECONDSs [FOLDER]]
#
#   scripts/fuzz.sh record            a million inputs, built in build-fuzz
#   scripts/fuzz.sh study 60s         as many as a minute allows
#   scripts/fuzz.sh all 60s           each target a minute
#   scripts/fuzz.sh --keep all 600s   also adds the run to tests/fuzz/runs.csv and writes docs/reliability.md from it
#   scripts/fuzz.sh --page            writes the page only
#
# Targets: record, study, results, campaign, table, hazard, decision. Needs clang++. Exit status 1 where something is
# found: it is kept as FOLDER/finding-TARGET-*, and fuzz_TARGET FILE reproduces it. New inputs are kept in
# FOLDER/found/TARGET, from which a later run goes on.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
runs=tests/fuzz/runs.csv
all=(record study results campaign table hazard decision)

# The sums over all runs, as a table.
page() {
    awk -F, 'NR > 1 {
        inputs[$4] += $5; hours[$4] += $8 / 3600; found[$4] += $10; edges[$4] = $6
        if ($9 > peak[$4]) peak[$4] = $9
        if (!($3 in machine)) { machine[$3] = 1; machines = machines (machines == "" ? "" : "; ") $3 }
        if (first == "") first = $1
        last = $1; commit = $2
    }
    END {
        printf "(%s to %s, last commit %s, %s; one process each.)\n\n", first, last, commit, machines
        print "| reader | inputs | hours | edges reached | peak memory, MB | findings, all mended |"
        print "|---|---:|---:|---:|---:|---:|"
        n = split("record study results campaign table hazard decision", names, " ")
        for (i = 1; i <= n; ++i)
            printf "| `%s` | %.3g million | %.2f | %d | %d | %d |\n", names[i], inputs[names[i]] / 1e6, hours[names[i]],
                   edges[names[i]], peak[names[i]], found[names[i]]
    }' "$runs" | scripts/into_page.sh fuzz.sh docs/reliability.md
}

keep=
case ${1:-} in
--keep) keep=yes; shift ;;
--page) page; exit ;;
esac
[[ $# -gt 0 ]] || { sed -n '2,16s/^# \?//p' "$0" >&2; exit 2; }
targets=("$1")
[[ $1 != all ]] || targets=("${all[@]}")
for target in "${targets[@]}"; do
    [[ " ${all[*]} " == *" $target "* ]] || { echo "fuzz.sh: '$target' is no target. Targets: all ${all[*]}" >&2; exit 2; }
done
case ${2:-1000000} in
*s) limit=-max_total_time=${2%s} ;;
*) limit=-runs=${2:-1000000} ;;
esac
build=${3:-build-fuzz}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="${CXX:-clang++}" \
    -DCMAKE_C_COMPILER="${CC:-clang}" -DSTYLOBATE_FUZZ=ON -DSTYLOBATE_BENCH=OFF -DSTYLOBATE_CUDA=OFF \
    -DSTYLOBATE_PYTHON=OFF -DSTYLOBATE_INSTALL=OFF >/dev/null
cmake --build "$build" --target "${targets[@]/#/fuzz_}"

# Files that readers take by their names lie in memory. Freed memory is watched, but not so much of it that the peak
# says nothing; where memory was allocated is not recorded, which takes a third of the time.
scratch=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch ASAN_OPTIONS=quarantine_size_mb=16:malloc_context_size=1:${ASAN_OPTIONS:-}

status=0
for target in "${targets[@]}"; do
    seeds=("tests/fuzz/corpus/$target") longest=4096 # bytes; shorter ones are quicker
    case $target in
    results | decision) longest=256 ;;
    table) longest=1024 ;;
    hazard | study) longest=2048 ;;
    esac
    [[ ! -d tests/fuzz/findings/$target ]] || seeds+=("tests/fuzz/findings/$target")
    [[ $target != study ]] || seeds+=(studies/inputs)
    found=$build/found/$target log=$build/$target.log
    mkdir -p "$found"
    begin=$SECONDS failed=0
    # memory: more than 32 MB at once, or 1 GB in all, is out of proportion to inputs of some kB
    code=0
    "$build/tests/fuzz/fuzz_$target" "$limit" "-max_len=$longest" -timeout=10 -malloc_limit_mb=32 -rss_limit_mb=1024 \
        -artifact_prefix="$build/finding-$target-" -print_final_stats=1 "$found" "${seeds[@]}" >"$log" 2>&1 || code=$?
    ((code == 0 || code == 72)) || failed=1 # 72: Ctrl-C
    count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
    peak=$(sed -n 's/^stat::peak_rss_mb: *//p' "$log" | tail -n 1)
    edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
    seconds=$((SECONDS - begin))
    echo "fuzz_$target: ${count:-0} inputs in $seconds s, ${edges:-0} edges, ${peak:-0} MB at most"
    if ((failed)); then
        status=1
        grep -aE '^finding:|ERROR|SUMMARY|runtime error|Test unit written' "$log" || tail -n 20 "$log"
    fi
    [[ -z $keep ]] || {
        processor=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1)
        echo "$(date -u +%F),$(git rev-parse --short HEAD),${processor//,/ },$target,${count:-0},${edges:-0},$(find "$found" -type f | wc -l),$seconds,${peak:-0},$failed" >>"$runs"
    }
done
[[ -z $keep ]] || page
exit $status
