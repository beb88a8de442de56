#!/usr/bin/env bash
# Makes the packages and uses them as their users do, in a bare Debian 12 of its own (debootstrap) without the sources, the
# build and, at first, a compiler: check_packages.sh PROGRAM BUILD_FOLDER SOURCE_FOLDER. Prints the times and sizes.
# Status 77 (skipped) where bare_debian.sh or lintian says so.
set -euo pipefail
program=$1 build=$2 source=$3
. "${BASH_SOURCE[0]%/*}/bare_debian.sh"
need lintian dpkg-shlibdeps
compgen -G "$build/python/stylobate/_core*.so" >/dev/null || skip "the build has no Python module"

timed "the packages are made from a build, lintian finds no error" \
    env STYLOBATE_BUILD="$build" "$source/scripts/package.sh" "$work/packages"
grep installed "$work/log" | sed "s|$work/packages/||"
for package in "$work"/packages/*.deb; do
    dpkg-deb --extract "$package" "$work/content"
done
names_no_place "$work/content" "$build" "$source"

bare_debian
cp "$work"/packages/*.deb "$root/var/tmp"
first=$EPOCHREALTIME
timed "apt update" in_root "apt-get update"
timed "apt install ./stylobate_*.deb" in_root "cd /var/tmp && apt-get install --yes ./stylobate_*.deb"
in_root "! command -v cc && ! command -v c++ && ! command -v cmake" || fail "there is a compiler"

# a surface and its page; the same numbers as those of the build
reduced="--set study.realizations=16"
study=small_scale_column
timed "the first surface, 4096 realizations" as_user \
    "stylobate run /usr/share/stylobate/inputs/$study.toml -o column.h5 $reduced"
head -n 1 "$work/log"
timed "its page" as_user "stylobate report column.h5"
since "$first" "from apt update to the page"
timed "its picture, by librsvg" as_user "stylobate export column.h5 --to png"
as_user "stylobate export column.h5 --to csv -o tables --quiet" >/dev/null
"$program" run "$source/studies/inputs/$study.toml" -o "$work/column.h5" $reduced --quiet >/dev/null
"$program" export "$work/column.h5" --to csv -o "$work/tables" --quiet >/dev/null
diff -r "$work/tables" "$root/tmp/user/tables" || fail "the tables differ from those of the build"
grep -q '<svg' "$root/tmp/user/column.html" || fail "the page has no picture"
[[ $(head -c 8 "$root/tmp/user/column_surface.png" | od -An -tx1 | tr -d ' ') == 89504e470d0a1a0a ]] || fail "no PNG"

timed "apt install bash-completion man-db" in_root "apt-get install --yes --no-install-recommends bash-completion man-db"
as_user 'source /usr/share/bash-completion/bash_completion; _completion_loader stylobate || [[ $? == 124 ]]
    complete -p stylobate | grep -q _stylobate'
# what is excluded from the documentation of a container's Debian is no matter here: the file is there
as_user 'MANPAGER=cat man --warnings stylobate 2>warnings | grep -q "EXIT STATUS"; [[ ! -s warnings ]]'

timed "apt install ./python3-stylobate_*.deb" in_root "cd /var/tmp && apt-get install --yes ./python3-stylobate_*.deb"
timed "an example in Python: the surface as a table and a picture" as_user \
    "MPLBACKEND=Agg python3 /usr/share/doc/python3-stylobate/examples/surface.py column.h5 surface.png"
version=$(sed -n 's/^project(stylobate VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
timed "a study from Python" as_user "python3 -c '
import importlib.metadata
import stylobate
assert importlib.metadata.version(\"stylobate\") == \"$version\"
study = stylobate.Study.from_toml(\"/usr/share/stylobate/inputs/$study.toml\", {\"study.realizations\": 16})
module_share = stylobate.run(study).share(\"collapse\")
file_share = stylobate.Result(\"column.h5\").share(\"collapse\")
assert (module_share.count, module_share.trials) == (file_share.count, file_share.trials)
'"

timed "apt install ./stylobate-doc_*.deb" in_root "cd /var/tmp && apt-get install --yes ./stylobate-doc_*.deb"
python3 - "$root/usr/share/doc/stylobate" <<'PYTHON' || fail "links of the pages lead nowhere"
import pathlib, re, sys
root = pathlib.Path(sys.argv[1])
dead = [f"{page.relative_to(root)}: {link}" for page in root.rglob("*.md")
        for link in re.findall(r"\]\(([^)#\s]+)", re.sub(r"```.*?```", "", page.read_text(), flags=re.S))
        if ":" not in link and not (page.parent / link).exists()]
print("\n".join(dead), end="\n" if dead else "")
sys.exit(1 if dead else 0)
PYTHON

timed "apt install ./libstylobate-dev_*.deb g++ cmake make" in_root \
    "cd /var/tmp && apt-get install --yes --no-install-recommends ./libstylobate-dev_*.deb g++ cmake make"
timed "the examples in C++" as_user "cmake -S /usr/share/stylobate/examples -B examples && cmake --build examples &&
    examples/surface /usr/share/stylobate/inputs/$study.toml"

# the oldest processor of this architecture, without AVX and FMA: the same bytes
if emulator=$(command -v qemu-x86_64-static || command -v qemu-x86_64); then
    small="--set study.realizations=1 --set surface.frequency_hz.count=2 --set surface.pga_m_s2.count=2 --quiet"
    installed="$work/content/usr/bin/stylobate"
    timed "four realizations on an emulated processor without AVX" "$emulator" -cpu qemu64 "$installed" run \
        "$source/studies/inputs/$study.toml" -o "$work/emulated.h5" $small
    "$installed" run "$source/studies/inputs/$study.toml" -o "$work/native.h5" $small >/dev/null
    cmp "$work/emulated.h5" "$work/native.h5" || fail "another processor gives other bytes"
else
    echo "no processor without AVX was tried: qemu-user-static is not installed"
fi

in_root "apt-get purge --yes stylobate stylobate-doc python3-stylobate libstylobate-dev" >/dev/null 2>&1
left=$(find "$root/usr" "$root/var/lib/dpkg/info" -iname '*stylobate*')
[[ -z $left ]] || fail "after apt purge there is still: $left"
echo "all was found"
