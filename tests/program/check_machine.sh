#!/usr/bin/env bash
# The program where the machine gives it little: limits of the process, closed and full streams, no folder for temporary
# files, no terminal, a locale with decimal commas. It does its work, or says in one message what is missing; no results
# file is left that cannot be read. check_machine.sh PROGRAM SOURCE_DIR [sanitized]
# Sanitizers need open files and memory of their own, so that a sanitized program has no limits on these.
set -u
# what the caller left open would count among the open files
for descriptor in /proc/self/fd/*; do
    number=${descriptor##*/}
    [[ $number -le 2 || $number -eq 255 ]] || { exec {number}>&-; } 2>/dev/null
done
program=$1
sanitized=${3:-}
study=$2/studies/inputs/small_scale_column.toml
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0
settings=(--set study.realizations=2 --set 'surface.frequency_hz={from=2.0,to=4.0,count=2}'
    --set 'surface.pga_m_s2={from=4.0,to=12.0,count=2}' --set 'study.title="a"')
run=("$program" run "$study" "${settings[@]}" --quiet -o x.h5)
export_csv=("$program" export r.h5 --to csv -o x)
export_png=("$program" export r.h5 -o x.png)
report=("$program" report r.h5 -o x.html --animate 0)

fail()
{
    echo "FAILED: $*"
    sed 's/^/    /' err
    failures=$((failures + 1))
}

# expect NAME STATUS TEXT COMMAND...: the exit status, and what standard error has. What is begun is never left half
# done under its name.
expect()
{
    local name=$1 status=$2 text=$3
    shift 3
    "$@" > out 2> err < /dev/null
    local got=$?
    [ $got -eq "$status" ] || fail "$name: exit status $got instead of $status"
    if [ -n "$text" ]; then
        grep -q -- "$text" err || fail "$name: standard error lacks '$text'"
        [ "$(grep -c '^stylobate: ' err)" -eq 1 ] || fail "$name: more than one message, or none"
    fi
    if [ -e x.h5 ] && ! "$program" verify-file x.h5 --replay 0 > out 2> err; then
        fail "$name: the results cannot be verified"
    fi
    rm -rf x x.*
}
limited() # LIMIT VALUE COMMAND...
{
    (ulimit "$1" "$2" && shift 2 && exec "$@")
}

"$program" run "$study" "${settings[@]}" --quiet -o r.h5 > out 2> err || fail "run"
cp r.h5 good.h5

# open files: too few for a results file, for its second one, for a picture
if [ -z "$sanitized" ]; then
    expect "4 files, run" 2 "Too many open files" limited -n 4 "${run[@]}"
    expect "5 files, run" 1 "Too many open files" limited -n 5 "${run[@]}"
    expect "4 files, info" 2 "Too many open files" limited -n 4 "$program" info r.h5
    grep -q damaged err && fail "a file is called damaged that cannot be opened"
    expect "5 files, picture" 2 "Too many open files" limited -n 5 "${export_png[@]}"
fi

# size of files, in blocks of 1024 bytes
expect "small files, run" 2 "cannot be written" limited -f 8 "${run[@]}"
expect "small files, tables" 2 "cannot write" limited -f 1 "${export_csv[@]}"
expect "small files, picture" 2 "" limited -f 1 "${export_png[@]}"
expect "small files, page" 2 "cannot write" limited -f 8 "${report[@]}"

# memory: enough for a small study, and for none
[ -n "$sanitized" ] || expect "200 MB, run" 0 "" limited -v 200000 "${run[@]}" --threads 1

# streams that are closed or full
closed_output() { "$@" >&-; }
closed_error() { "$@" 2>&-; }
closed_input() { "$@" <&-; }
closed_all() { "$@" <&- >&- 2>&-; }
full_output() { "$@" > /dev/full; }
full_error() { "$@" 2> /dev/full; }
expect "closed output" 1 "standard output cannot be written" closed_output "$program" info r.h5
expect "full output" 1 "standard output cannot be written" full_output "$program" info r.h5
expect "closed output, --json" 1 "standard output cannot be written" closed_output "$program" verify-file r.h5 --json
for error in closed_error full_error; do
    expect "$error, run" 0 "" $error "$program" run "$study" "${settings[@]}" -o x.h5
    expect "$error, message" 2 "" $error "$program" info nothing.h5
done
expect "closed input" 0 "" closed_input "${run[@]}"
closed_all "${run[@]}"
cmp -s x.h5 good.h5 || fail "closed streams: the results are others"
rm -f x.h5

# no folder for temporary files, nothing in the environment
expect "no temporary folder" 2 "in '/no/such/folder': No such file" env TMPDIR=/no/such/folder "${export_png[@]}"
expect "no temporary folder, run" 0 "" env TMPDIR=/no/such/folder "${run[@]}"
empty=(env -i ${TSAN_OPTIONS:+"TSAN_OPTIONS=$TSAN_OPTIONS"}) # what TSan is told not to report
expect "no environment" 0 "" "${empty[@]}" "${run[@]}"
expect "no environment, picture" 0 "" "${empty[@]}" "${export_png[@]}"

# decimal commas, where the locale can be made
"${export_csv[@]}" > out 2> err && mv x good_csv
if localedef -i de_DE -f UTF-8 "$folder/de_DE.UTF-8" > /dev/null 2>&1; then
    comma=(env LOCPATH="$folder" LC_ALL=de_DE.UTF-8)
    [ "$("${comma[@]}" printf %.1f 1,5)" = 1,5 ] || fail "the locale has no comma"
    "${comma[@]}" "${run[@]}" > out 2> err || fail "run with decimal commas"
    cmp -s x.h5 good.h5 || fail "decimal commas: the results are others"
    "${comma[@]}" "${export_csv[@]}" > out 2> err || fail "tables with decimal commas"
    diff -r x good_csv > /dev/null || fail "decimal commas: the tables are others"
    "${comma[@]}" "$program" export r.h5 -o x.svg > out 2> err || fail "picture with decimal commas"
    "$program" export r.h5 -o y.svg > out 2> err || fail "picture"
    cmp -s x.svg y.svg || fail "decimal commas: the picture is another"
else
    echo "no locale with decimal commas can be made here"
fi

cmp -s r.h5 good.h5 || fail "the results have changed"
[ $failures -eq 0 ] && echo "all passed"
exit $((failures > 0))
