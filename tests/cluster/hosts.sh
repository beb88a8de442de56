#!/usr/bin/env bash
# Several hosts on this machine, as name spaces of its kernel: each has a name (host1, host2, ...), a network stack of
# its own (10.77.0.1, ... on one bridge) and a folder OWN that the others do not see; the rest of the file system is
# shared, as on a cluster. Runs a command on the first one.
#
#   tests/cluster/hosts.sh N COMMAND...     exit status 77 with a message where this user may not make name spaces
#
# The command finds HOSTS (all names), OWN, and the programs
#   on HOST COMMAND...    runs it on that host, as ssh does: by a shell
#   kill_host HOST        ends all processes on it
set -euo pipefail

n=$1
shift
export PATH=$PATH:/usr/sbin
for program in unshare nsenter ip; do
    command -v "$program" >/dev/null || { echo "skipped: no $program (apt install iproute2 util-linux)"; exit 77; }
done
unshare --net --uts --mount true 2>/dev/null || { echo "skipped: this user may not make name spaces"; exit 77; }

folder=$(mktemp -d)
mkdir "$folder"/{bin,own,host}
holders=() # processes that hold the name spaces: nothing of them is left when they end
stop() {
    for name in $HOSTS; do "$folder/bin/kill_host" "$name"; done
    kill -KILL "${holders[@]}" && wait || true
    rm -rf "$folder"
} 2>/dev/null
HOSTS=
trap stop EXIT

hold() { # OPTION OF unshare...: a process in name spaces of its own; `held` is its number
    unshare "$@" sleep infinity &
    held=$!
    holders+=("$held")
    until [[ $(readlink "/proc/$held/ns/net") != "$(readlink /proc/self/ns/net)" &&
        $(cat "/proc/$held/comm") == sleep ]]; do sleep 0.01; done
}

cat >"$folder/bin/on" <<ON
#!/usr/bin/env bash
host=\$1
shift
exec nsenter --target "\$(cat "$folder/host/\$host")" --net --uts --mount sh -c "cd '\$PWD'; \$*"
ON
cat >"$folder/bin/kill_host" <<KILL
#!/usr/bin/env bash
holder=\$(cat "$folder/host/\$1")
# one process for all of /proc: a run may end while a slow loop looks for its ranks
find /proc/[0-9]*/ns/net -maxdepth 0 -printf '%l %p\n' 2>/dev/null |
    awk -F'[ /]' -v net="\$(readlink "/proc/\$holder/ns/net")" -v holder="\$holder" '\$1 == net && \$4 != holder { print \$4 }' |
    xargs -r kill -KILL 2>/dev/null
exit 0
KILL
chmod +x "$folder"/bin/*

hold --net
bridge=(nsenter --target "$held" --net ip link)
"${bridge[@]}" add bridge type bridge
"${bridge[@]}" set bridge up
echo "127.0.0.1 localhost" >"$folder/names"
for ((i = 1; i <= n; ++i)); do echo "10.77.0.$i host$i" >>"$folder/names"; done
for ((i = 1; i <= n; ++i)); do
    hold --net --uts --mount
    echo "$held" >"$folder/host/host$i"
    "${bridge[@]}" add "port$i" type veth peer name eth0 netns "$held"
    "${bridge[@]}" set "port$i" master bridge up
    "$folder/bin/on" "host$i" "hostname host$i; ip address add 10.77.0.$i/24 dev eth0; ip link set eth0 up; ip link set lo up
        mount --bind '$folder/names' /etc/hosts; mount -t tmpfs own '$folder/own'"
    HOSTS+="host$i "
done
export HOSTS OWN=$folder/own PATH=$folder/bin:$PATH
on host1 "$(printf '%q ' "$@")"
