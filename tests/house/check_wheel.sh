#!/usr/bin/env bash
# Makes the wheel and uses it as its users do, in a bare Debian 12 of its own (debootstrap) with Python, pip and NumPy
# alone: check_wheel.sh PROGRAM BUILD_FOLDER SOURCE_FOLDER. Prints the times and sizes. Status 77 (skipped) where
# bare_debian.sh says so, or where the build has no Python module or no static HDF5.
set -euo pipefail
program=$1 build=$2 source=$3
. "${BASH_SOURCE[0]%/*}/bare_debian.sh"
need patchelf readelf python3
grep -q '^STYLOBATE_STATIC_HDF5:FILEPATH=/' "$build/CMakeCache.txt" || skip "the build has no Python module or no static HDF5"

timed "the wheel is made from a build" env STYLOBATE_BUILD="$build" "$source/scripts/package.sh" --wheel "$work/wheels"
tail -n 1 "$work/log" | sed "s|$work/wheels/||"
wheel=$(echo "$work"/wheels/*.whl)
[[ $wheel == *-cp311-cp311-manylinux_2_36_x86_64.whl ]] || fail "the name $wheel"
env STYLOBATE_BUILD="$build" "$source/scripts/package.sh" --wheel "$work/again" >/dev/null
cmp "$wheel" "$work"/again/*.whl || fail "the same build gives other bytes"
python3 -m zipfile -e "$wheel" "$work/content"
names_no_place "$work/content" "$build" "$source"

# what it is linked with is in it, or is where every wheel of its name expects it; of HDF5 nothing is seen
for file in "$work"/content/stylobate/_core*.so "$work"/content/stylobate/_bundled/*; do
    for name in $(readelf --dynamic --wide "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
        [[ -e $work/content/stylobate/_bundled/$name || $name =~ ^(lib(c|m|gcc_s|z|stdc\+\+)|ld-linux-x86-64)\.so ]] ||
            fail "$file needs $name"
    done
    ! readelf --dyn-syms --wide "$file" | grep -wE "H5[A-Z]+[a-z_]+\w*|GLIBC_2\.(3[7-9]|[4-9][0-9])" || fail "$file has these names"
done

bare_debian python3 python3-venv python3-numpy
in_root "! command -v cc && ! ls /usr/lib/*/libhdf5* /usr/lib/*/libtbb* /usr/lib/*/librsvg* 2>/dev/null" ||
    fail "this Debian is not bare"
cp "$wheel" "$root/var/tmp"
python=env/bin/python
study=small_scale_column
input=env/share/stylobate/inputs/$study.toml
timed "python3 -m venv --system-site-packages" as_user "python3 -m venv --system-site-packages env"
first=$EPOCHREALTIME
timed "pip install --no-index FILE" as_user "env/bin/pip install --no-index /var/tmp/stylobate-*.whl"
timed "the first surface from Python, 4096 realizations" as_user "$python -c '
import numpy, stylobate
study = stylobate.Study.from_toml(\"$input\", {\"study.realizations\": 16})
share = stylobate.run(study, \"python.h5\").share(\"collapse\")
print(share.probability)
'"
since "$first" "from pip install to the first surface"
timed "the same surface by the command" as_user "env/bin/stylobate run $input -o column.h5 --set study.realizations=16"
grep '^column.h5: ' "$work/log"
timed "its page" as_user "env/bin/stylobate report column.h5"
"$program" run "$source/studies/inputs/$study.toml" -o "$work/column.h5" --set study.realizations=16 --quiet >/dev/null
for file in python.h5 column.h5; do
    cmp "$work/column.h5" "$root/tmp/user/$file" || fail "$file has not the bytes of the build's"
done

# what is missing is named, with the remedy
as_user "env/bin/stylobate export column.h5 --to svg >/dev/null
    ! env/bin/stylobate export column.h5 --to png 2>message; grep -q 'apt install librsvg2-2' message
    ! env/bin/stylobate run $input -o mpi.h5 --mpi 2>message; grep -q MPI message
    env/bin/stylobate info | grep -q '^MPI: none'"
as_user "mv env/lib/python3.11/site-packages/stylobate away
    ! env/bin/stylobate info 2>message; grep -q 'Install the wheel again' message
    mv away env/lib/python3.11/site-packages/stylobate"

timed "apt install librsvg2-2 fonts-dejavu-core" in_root "apt-get update &&
    apt-get install --yes --no-install-recommends librsvg2-2 fonts-dejavu-core"
as_user "env/bin/stylobate export column.h5 --to png && $python -c '
import stylobate
study = stylobate.Study.from_toml(\"$input\")
study.check(trial_seconds=0, law_seconds=0).draw(\"drawing.png\")'" >/dev/null
for picture in column_surface drawing; do
    [[ $(head -c 8 "$root/tmp/user/$picture.png" | od -An -tx1 | tr -d ' ') == 89504e470d0a1a0a ]] || fail "no $picture.png"
done

# beside h5py, whose HDF5 is another one
timed "apt install python3-h5py" in_root "apt-get install --yes --no-install-recommends python3-h5py"
for order in "h5py, stylobate" "stylobate, h5py"; do
    timed "import $order: each reads what the other has written, by turns" as_user "$python -c '
import $order
settings = {\"study.realizations\": 1, \"surface.frequency_hz.count\": 2, \"surface.pga_m_s2.count\": 2}
study = stylobate.Study.from_toml(\"$input\", settings)
with h5py.File(\"other.h5\", \"w\") as other:
    other[\"x\"] = 1.0
    made = stylobate.run(study, \"small.h5\")
    other[\"y\"] = 2.0
    with h5py.File(\"small.h5\") as small:
        names = []
        small.visit(names.append)
        assert len(names) > 3, names
    assert stylobate.Result(\"small.h5\").count == made.count == 4
with h5py.File(\"other.h5\") as other:
    assert (other[\"x\"][()], other[\"y\"][()]) == (1.0, 2.0)
maps = open(\"/proc/self/maps\").read()
assert \"libhdf5\" in maps and \"libtbb-stylobate\" in maps and \"libtbb.so\" not in maps
'"
    as_user "rm small.h5 other.h5"
done

# the oldest processor of this architecture, without AVX and FMA: the same bytes, and what is used is said
if emulator=$(command -v qemu-x86_64-static); then
    cp "$emulator" "$root/var/tmp/emulator"
    as_user "/var/tmp/emulator -cpu qemu64 env/lib/python3.11/site-packages/stylobate/_bundled/stylobate info |
        grep -q '^instruction sets: scalar (used: scalar'"
    timed "four realizations from Python on an emulated processor without AVX" as_user "
        /var/tmp/emulator -cpu qemu64 $python -c '
import stylobate
settings = {\"study.realizations\": 1, \"surface.frequency_hz.count\": 2, \"surface.pga_m_s2.count\": 2}
stylobate.run(stylobate.Study.from_toml(\"$input\", settings), \"emulated.h5\")
'"
    "$program" run "$source/studies/inputs/$study.toml" -o "$work/native.h5" --set study.realizations=1 \
        --set surface.frequency_hz.count=2 --set surface.pga_m_s2.count=2 --quiet >/dev/null
    cmp "$root/tmp/user/emulated.h5" "$work/native.h5" || fail "another processor gives other bytes"
else
    echo "no processor without AVX was tried: qemu-user-static is not installed"
fi

as_user "env/bin/pip uninstall --yes --quiet stylobate"
left=$(find "$root/tmp/user/env" -type f -path '*stylobate*')
[[ -z $left ]] || fail "after pip uninstall there is still: $left"

# for all users, without a virtual environment
timed "pip install --break-system-packages, as root" in_root "apt-get install --yes --no-install-recommends python3-pip &&
    pip install --no-index --break-system-packages --root-user-action ignore /var/tmp/stylobate-*.whl"
as_user "/usr/local/bin/stylobate info && python3 -c 'import stylobate'" >/dev/null
echo "all was found"
