#!/usr/bin/env bash
# A cluster of this machine alone, or of the hosts of hosts.sh, without systemd: starts munged, slurmctld and slurmd in a
# folder, and runs a command with the commands of Slurm in that cluster.
#
#   tests/cluster/slurm.sh FOLDER COMMAND...     exit status 77 with a message where Slurm is not installed
set -euo pipefail

folder=$1
shift
for program in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || {
        echo "skipped: $program is not installed (apt install slurm-wlm)"
        exit 77
    }
done
[[ $(id -u) -eq 0 ]] || { echo "skipped: slurmd wants to be root"; exit 77; }
export PATH=$PATH:/usr/sbin

mkdir -p "$folder/state"
chmod 755 "$folder"
(umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
nodes=${HOSTS:-$(hostname -s)}
controller=${nodes%% *}
at() { [[ -n ${HOSTS:-} ]] && echo "$1" || echo 127.0.0.1; } # the address of a host
port=$((20000 + $$ % 20000))
cat >"$folder/slurm.conf" <<CONF
ClusterName=stylobate
SlurmctldHost=$controller($(at "$controller"))
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket,cred_expire=15
CryptoType=crypto/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmdParameters=config_overrides
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobRequeue=1
ReturnToService=2
MinJobAge=3600
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool_%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd_%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd_%n.log
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
for node in $nodes; do # no job of three processes fits on one of several hosts
    echo "NodeName=$node NodeAddr=$(at "$node") CPUs=$([[ -n ${HOSTS:-} ]] && echo 2 || echo 4) RealMemory=1000"
done >>"$folder/slurm.conf"
export SLURM_CONF=$folder/slurm.conf

# Waits for the daemons: until they have ended they write into the folder.
stop() {
    local daemon pid
    for daemon in "$folder"/slurmd_*.pid "$folder"/{slurmctld,munged}.pid; do
        pid=$(cat "$daemon" 2>/dev/null) || continue
        kill "$pid" 2>/dev/null || continue
        while kill -0 "$pid" 2>/dev/null; do sleep 0.1; done
    done
}
trap stop EXIT
munged --force --socket="$folder/munge.socket" --key-file="$folder/munge.key" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
slurmctld -c
for node in $nodes; do
    if [[ -n ${HOSTS:-} ]]; then on "$node" slurmd; else slurmd; fi
done
for ((i = 0; ; ++i)); do # until the nodes are there
    [[ $(sinfo --noheader --Node --format=%T 2>/dev/null | sort -u) == idle ]] && break
    [[ $i -lt 600 ]] || { echo "the nodes do not come up:"; tail "$folder"/*.log; exit 1; }
    sleep 0.1
done
"$@"
