#!/usr/bin/env bash
# one_node_cluster.sh start|stop FOLDER: a Slurm cluster of this one machine, as root, with all its files in FOLDER.
# `start` prints the SLURM_CONF to use. For tests: wants the packages slurm-wlm and munge.
set -euo pipefail

folder=$(realpath -m "$2")

# Daemons save their state on the way out, so the folder is not theirs any more only once they are gone.
stop() {
  local name pid try
  for name in slurmd slurmctld munged; do
    pid=$(cat "$folder/$name.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || true
    for try in $(seq 100); do
      kill -0 "$pid" 2>/dev/null || break
      sleep 0.1
    done
  done
}

start() {
  mkdir -p "$folder/state" "$folder/spool" "$folder/munge"
  [ -s "$folder/munge/key" ] || dd if=/dev/urandom of="$folder/munge/key" bs=1024 count=1 status=none
  chmod 0400 "$folder/munge/key"
  chown -R munge: "$folder/munge"
  # munged insists on parents that nobody else may write to, which a temporary folder's are not.
  setsid runuser -u munge -- munged --force --foreground --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" \
    >"$folder/munged.out" 2>&1 &
  echo $! >"$folder/munged.pid"

  local cpus
  cpus=$(nproc)
  cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=localhost
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
MpiDefault=none
ReturnToService=2
SlurmctldPort=46817
SlurmdPort=46818
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=localhost CPUs=$cpus State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF="$folder/slurm.conf"
  local try
  for try in $(seq 50); do [ -S "$folder/munge/socket" ] && break; sleep 0.1; done
  slurmctld >"$folder/slurmctld.out" 2>&1
  slurmd -N localhost >"$folder/slurmd.out" 2>&1
  for try in $(seq 100); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && { echo "$SLURM_CONF"; return; }
    sleep 0.2
  done
  echo "the cluster did not come up: see $folder" >&2
  stop
  return 1
}

"$1"
