#!/usr/bin/env bash
# Several hosts (hosts.sh): ranks of MPI on three hosts that meet by TCP alone, with results in a folder that the first
# one alone has; a host that dies, and one that is cut off from the network, while they run, continued by the others;
# shards in each host's own folder, joined on the first. All have the bytes of one process.
#
#   tests/cluster/check_hosts.sh PROGRAM SOURCE
set -euo pipefail

program=$1 source=$2
[[ -n ${HOSTS:-} ]] || exec "$source/tests/cluster/hosts.sh" 3 "$0" "$@"
command -v mpirun >/dev/null || { echo "skipped: no mpirun (Debian: libopenmpi-dev)"; exit 77; }
"$program" info | grep -q "^MPI: .*MPI" || { echo "skipped: the program was built without MPI"; exit 77; }
fail() { echo "$*"; exit 1; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
cd "$OWN"
export TMPDIR=$OWN

study=$source/studies/inputs/small_scale_column.toml
axes=(--set surface.frequency_hz='{ from = 4.0, to = 8.0, count = 2 }'
      --set surface.pga_m_s2='{ from = 4.0, to = 12.0, count = 2 }' --quiet)
# A host that does not answer for 16 s is lost (Open MPI's default: eight minutes).
ranks() { # HOSTS, with commas
    mpirun --mca plm_rsh_agent on --mca plm_rsh_no_tree_spawn 1 --mca oob_tcp_keepalive_time 10 \
        --mca oob_tcp_keepalive_intvl 2 --mca oob_tcp_keepalive_probes 3 --host "$1" -n "$(tr , '\n' <<<"$1" | wc -l)" \
        "$program" run "${@:2}" --mpi --threads 1
}

run=("$study" "${axes[@]}" --set study.realizations=100)
"$program" run "${run[@]}" -o one.h5 >/dev/null
ranks host1,host2,host3 "${run[@]}" -o hosts.h5 >/dev/null
cmp one.h5 hosts.h5 || fail "ranks on three hosts: other bytes"
for host in host2 host3; do
    [[ -z $(on $host "ls '$OWN' | grep h5") ]] || fail "$host wrote results"
done
echo "three hosts: the same bytes, in a folder that host1 alone has"

run=("$study" "${axes[@]}" --set study.realizations=1000)
"$program" run "${run[@]}" -o whole.h5 >/dev/null
for disturbed in "kill_host host3" "on host2 ip link set eth0 down"; do
    rm -f lost.h5
    ranks host1,host2,host3 "${run[@]}" -o lost.h5 >lost.log 2>&1 &
    until [[ -e lost.h5 && $(stat -c %s lost.h5) -gt 60000 ]]; do
        kill -0 $! || { cat lost.log; fail "the run ends before a host is lost"; }
        sleep 0.01
    done
    $disturbed
    ! wait $! || fail "$disturbed: the run ends well"
    "$program" info lost.h5 >/dev/null
    on host2 ip link set eth0 up
    ranks host1,host3 "${run[@]}" -o lost.h5 >/dev/null
    cmp whole.h5 lost.h5 || fail "$disturbed: other bytes after it was continued"
    echo "$disturbed: continued to the same bytes by two hosts"
done

for host in $HOSTS; do
    on "$host" "cd '$OWN' && '$program' run $(printf '%q ' "${run[@]}") --shard ${host#host}/3 -o shard.h5 >/dev/null" &
    shards+=($!)
done
for shard in "${shards[@]}"; do wait "$shard"; done
for host in $HOSTS; do on "$host" "cat '$OWN/shard.h5'" >"$host.h5"; done
"$program" merge host3.h5 host1.h5 host2.h5 -o merged.h5 --quiet
cmp whole.h5 merged.h5 || fail "shards of three hosts: other bytes"
echo "shards of three hosts: the same bytes"
