#!/usr/bin/env bash
# Runs the whole suite under sanitizers, in one pass of one commit each:
#
#   scripts/sanitizers.sh [--keep] asan|tsan|all [-- CTEST ARGUMENTS]
#
#   asan       AddressSanitizer and UndefinedBehaviorSanitizer; tsan: ThreadSanitizer; all: one after the other
#   --keep     adds the pass to tests/sanitizer_passes.csv and writes docs/reliability.md from it
#   --page     writes the page only
#
# An hour or two of two cores each. Exit status 1 where a test fails. The log is build/asan/pass.log.
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

# What a JUnit file says: the numbers of tests, of failed and of skipped ones, and the names of the last.
counts() {
    /usr/bin/python3 - "$1" <<'PY'
import sys
import xml.etree.ElementTree as xml

cases = list(xml.parse(sys.argv[1]).getroot().iter("testcase"))
skipped = [case.get("name") for case in cases if case.get("status") == "notrun" or case.find("skipped") is not None]
failed = [case for case in cases if case.get("status") == "fail"]
print(f"{len(cases)},{len(failed)},{len(skipped)},{';'.join(sorted(skipped))}")
PY
}

keep=
case ${1:-} in
--keep) keep=yes; shift ;;
--page) page; exit ;;
esac
case ${1:-} in
asan | tsan) presets=("$1") ;;
all) presets=(asan tsan) ;;
*) sed -n '2,11s/^# \?//p' "$0" >&2; exit 2 ;;
esac
shift
[[ ${1:-} != -- ]] || shift
[[ -z $keep || $# -eq 0 ]] || { echo "sanitizers.sh: --keep is for whole passes, without CTEST ARGUMENTS" >&2; exit 2; }

scripts/install_packages.sh --tests
commit=$(git describe --always --dirty --exclude '*')
processor=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1)
status=0
for preset in "${presets[@]}"; do
    log=build/$preset/pass.log xml=build/$preset/pass.xml
    rm -f "$xml" # of an earlier pass
    begin=$SECONDS
    cmake --preset "$preset" >/dev/null
    cmake --build "build/$preset" --parallel "$(nproc)"
    built=$SECONDS
    scripts/test.sh "--$preset" -- --output-junit pass.xml "$@" 2>&1 | tee "$log" || status=1
    ended=$SECONDS
    [[ -f $xml ]] || { echo "sanitizers.sh: the tests did not run to their end, see $log" >&2; exit 1; }
    [[ -z $keep ]] ||
        echo "$(date -u +%F),$commit,${processor//,/ },$(nproc),$preset,$(((built - begin + 59) / 60)),$(((ended - built + 59) / 60)),$(counts "$xml")" >>"$passes"
done
[[ -z $keep ]] || page
exit $status
