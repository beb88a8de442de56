# Sourced by the checks of packages: a bare Debian 12 of their own (debootstrap), without the sources, the build and a
# compiler, and how to do things in it. They are skipped (status 77) where they are not run as root, or where debootstrap,
# namespaces or a mirror of Debian is missing. Sets `work`, a folder that goes with the check, and `root`, where it will be.
suite=bookworm

skip() {
    echo "skipped: $1"
    exit 77
}
need() { # TOOL...
    local tool
    for tool in "$@"; do
        command -v "$tool" >/dev/null || skip "$tool is not installed"
    done
}
[[ $(id -u) -eq 0 ]] || skip "a bare Debian needs root"
need debootstrap unshare
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Codename: $suite" "Origin: Debian" "Created-By: Packages" | head -n 1)
[[ -n $mirror ]] || skip "apt has no mirror of Debian 12 ($suite)"

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
/usr/lib/apt/apt-helper download-file "${mirror%/}/dists/$suite/InRelease" "$work/InRelease" >/dev/null 2>&1 ||
    skip "$mirror cannot be reached"
root=$work/root
unshare --mount --pid --fork true 2>/dev/null || skip "there are no namespaces here (unshare)"

fail() {
    echo "${0##*/}: $1" >&2
    exit 1
}
timed() { # LABEL COMMAND...
    local begin=$EPOCHREALTIME
    "${@:2}" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        fail "$1 failed, see above"
    }
    printf '%6.1f s  %s\n' "$(awk "BEGIN { print $EPOCHREALTIME - $begin }")" "$1"
}
since() { # BEGIN LABEL
    printf '%6.1f s  %s\n' "$(awk "BEGIN { print $EPOCHREALTIME - $1 }")" "$2"
}
bare_debian() { # [PACKAGE...]
    local IFS=,
    timed "a bare Debian 12 (debootstrap, minbase${*:+, $*})" \
        debootstrap --variant=minbase ${*:+"--include=$*"} "$suite" "$root" "$mirror"
}
in_root() { # COMMAND: as root; /proc is there, and gone with the command
    unshare --mount --pid --fork bash -c "mount -t proc proc '$root/proc' && exec chroot '$root' /usr/bin/env -i \
        PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive HOME=/tmp LC_ALL=C.UTF-8 bash -euc \"\$0\"" "$1"
}
as_user() { in_root "mkdir -p /tmp/user && chown nobody /tmp/user && cd /tmp/user && exec setpriv --reuid nobody \
    --regid nogroup --clear-groups env HOME=/tmp/user bash -euc $(printf %q "$1")"; }
names_no_place() { # FOLDER PLACE...: its files do not name these folders
    local place
    for place in "${@:2}"; do
        ! grep -raF -e "$place/" "$1" --files-with-matches || fail "these files name $place"
    done
}
