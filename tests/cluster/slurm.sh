#!/usr/bin/env bash
# A cluster of this machine alone, without systemd: starts munged, slurmctld and slurmd in a folder, and runs a command
# with the commands of Slurm in that cluster.
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

mkdir -p "$folder"/{state,spool}
chmod 755 "$folder"
(umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
host=$(hostname -s)
port=$((20000 + $$ % 20000))
cat >"$folder/slurm.conf" <<CONF
ClusterName=stylobate
SlurmctldHost=$host(127.0.0.1)
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
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=4 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf

# Waits for the daemons: until they have ended they write into the folder.
stop() {
    local daemon pid
    for daemon in slurmd slurmctld munged; do
        pid=$(cat "$folder/$daemon.pid" 2>/dev/null) || continue
        kill "$pid" 2>/dev/null || continue
        while kill -0 "$pid" 2>/dev/null; do sleep 0.1; done
    done
}
trap stop EXIT
munged --force --socket="$folder/munge.socket" --key-file="$folder/munge.key" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
slurmctld -c
slurmd
for ((i = 0; ; ++i)); do # until the node is there
    [[ $(sinfo --noheader --format=%T 2>/dev/null) == idle ]] && break
    [[ $i -lt 600 ]] || { echo "the node does not come up:"; tail "$folder"/*.log; exit 1; }
    sleep 0.1
done
"$@"
