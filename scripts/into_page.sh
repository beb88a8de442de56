#!/usr/bin/env bash
# Puts tables (standard input) into a page, between the marks of the script that wrote them.
#
#   scripts/into_page.sh SCRIPT PAGE      marks: <!-- scripts/SCRIPT writes what follows -->
#                                                <!-- end of what scripts/SCRIPT writes -->
set -euo pipefail

script=$1 page=$2
tables=$(mktemp)
trap 'rm -f "$tables" "$tables.page"' EXIT
cat >"$tables"
for mark in "<!-- scripts/$script writes what follows -->" "<!-- end of what scripts/$script writes -->"; do
    grep -qF -- "$mark" "$page" || { echo "$page has no line '$mark'" >&2; exit 1; }
done
awk -v tables="$tables" -v begin="<!-- scripts/$script writes what follows -->" -v end="<!-- end of what scripts/$script writes -->" '
    index($0, end) { inside = 0 }
    !inside { print }
    index($0, begin) { inside = 1; print ""; while ((getline line < tables) > 0) print line; print "" }
' "$page" >"$tables.page"
cat "$tables.page" >"$page"
echo "$page"
