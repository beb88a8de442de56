#!/usr/bin/env bash
# Runs the whole suite under sanitizers, in one pass of one commit each:
#
#   scripts/sanitizers.sh [--keep] asan|tsan|all [-- CTEST ARGUMENTS]
#
#   asan       AddressSanitizer and UndefinedBehaviorSanitizer; tsan: ThreadSanitizer; all: one after the other
#   --keep     adds the pass to tests/sanitizer_passes.csv and writes docs/reliability.md from it
#   --page     writes the page only
#
# An hour or two of two cores each. Exit status 1 where a test fails. The tests run in portions, which are kept in
# build/asan/pass: the same command for the same commit goes on where it was interrupted. The log is pass.log there.
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
passes=tests/sanitizer_passes.csv

# The last pass under each sanitizer, as a table.
page() {
    awk -F, 'NR > 1 { row[$5] = $0 }
    END {
        title["asan"] = "AddressSanitizer, UndefinedBehaviorSanitizer"
        title["tsan"] = "ThreadSanitizer"
        print "| sanitizer | commit, date, machine | build, min | tests, min | tests | passed | skipped | failed |"
        print "|---|---|---:|---:|---:|---:|---|---:|"
        n = split("asan tsan", names, " ")
        for (i = 1; i <= n; ++i)
            if (split(row[names[i]], f, ",")) {
                gsub(";", "`, `", f[11])
                printf "| %s | %s, %s, %s cores of %s | %d | %d | %d | %d | %d%s | %d |\n", title[names[i]], f[2], f[1], f[4],
                       f[3], f[6], f[7], f[8], f[8] - f[9] - f[10], f[10], f[10] ? ": `" f[11] "`" : "", f[9]
            }
    }' "$passes" | scripts/into_page.sh sanitizers.sh docs/reliability.md
}

# What JUnit files say together: the numbers of tests, of failed and of skipped ones, and the names of the last. A test
# that others need runs with each portion of them.
counts() {
    /usr/bin/python3 - "$@" <<'PY'
import sys
import xml.etree.ElementTree as xml

names, failed, skipped = set(), set(), set()
for path in sys.argv[1:]:
    for case in xml.parse(path).getroot().iter("testcase"):
        names.add(case.get("name"))
        if case.get("status") == "fail":
            failed.add(case.get("name"))
        if case.get("status") == "notrun" or case.find("skipped") is not None:
            skipped.add(case.get("name"))
print(f"{len(names)},{len(failed)},{len(skipped)},{';'.join(sorted(skipped))}")
PY
}

# How many tests there are. (CTest's option -I wants their places among these, which are not the numbers that it shows.)
number_of_tests() {
    ctest --preset "$1" -N --label-exclude long "${@:2}" | sed -n 's/^Total Tests: *//p'
}

keep=
case ${1:-} in
--keep) keep=yes; shift ;;
--page) page; exit ;;
esac
case ${1:-} in
asan | tsan) presets=("$1") ;;
all) presets=(asan tsan) ;;
*) sed -n '2,12s/^# \?//p' "$0" >&2; exit 2 ;;
esac
shift
[[ ${1:-} != -- ]] || shift
[[ -z $keep || $# -eq 0 ]] || { echo "sanitizers.sh: --keep is for whole passes, without CTEST ARGUMENTS" >&2; exit 2; }

scripts/install_packages.sh --tests
commit=$(git describe --always --dirty --exclude '*')
processor=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1)
status=0
for preset in "${presets[@]}"; do
    pass=build/$preset/pass/$commit
    if [[ $# -gt 0 || $commit == *-dirty ]]; then # a part, or what no commit names
        pass=build/$preset/pass/part
        rm -rf "$pass"
    fi
    mkdir -p "$pass"
    log=$pass/pass.log
    begin=$SECONDS
    cmake --preset "$preset" >/dev/null
    cmake --build "build/$preset" --parallel "$(nproc)"
    [[ -e $pass/built ]] || echo $((SECONDS - begin)) >"$pass/built"
    all=$(number_of_tests "$preset" "$@")
    for ((first = 1; first <= all; first += 100)); do
        xml=$pass/$first.xml
        [[ ! -f $xml ]] || continue # it ran before an interruption
        rm -f "$xml.part"
        begin=$SECONDS
        scripts/test.sh "--$preset" -- "$@" -I "$first,$((first + 99))" --output-junit "$PWD/$xml.part" \
            2>&1 | tee -a "$log" || true
        [[ -f $xml.part ]] || { echo "sanitizers.sh: the tests did not run to their end, see $log" >&2; exit 1; }
        echo $((SECONDS - begin)) >"$pass/$first.seconds"
        mv "$xml.part" "$xml"
    done
    found=$(counts "$pass"/*.xml)
    echo "sanitizers.sh: $preset, $commit: tests, failed, skipped: $found"
    [[ $(cut -d, -f1 <<<"$found") -eq $all ]] || { echo "sanitizers.sh: of $all tests others did not run" >&2; exit 1; }
    [[ $(cut -d, -f2 <<<"$found") -eq 0 ]] || status=1
    seconds=$(awk '{ s += $1 } END { print s }' "$pass"/*.seconds)
    [[ -z $keep ]] ||
        echo "$(date -u +%F),$commit,${processor//,/ },$(nproc),$preset,$((($(<"$pass/built") + 59) / 60)),$(((seconds + 59) / 60)),$found" >>"$passes"
done
[[ -z $keep ]] || page
exit $status
