#!/usr/bin/env bash
# slurm.sh PROGRAM DESIGN: a sweep as an array of 8 tasks (16 where CI is set), all at once, under a real Slurm on the loopback interface, held byte
# for byte against the same sweep in one process. 77 (skipped) where Slurm is not installed or cannot run here.
set -u
program=$1 design=$2
skip() { echo "skipped: $1"; exit 77; }
for tool in slurmctld slurmd sbatch squeue scontrol; do command -v $tool >/dev/null || skip "$tool is not installed"; done
[ "$(id -u)" -eq 0 ] || skip "the daemons of Slurm need root"
plugins=$(dirname "$(find /usr/lib -name auth_none.so 2>/dev/null | head -n 1)")
[ -e "$plugins/auth_none.so" ] || skip "Slurm comes without its plugin auth/none"

place=$(mktemp -d)
daemons=()
finish() {
  for daemon in "${daemons[@]}"; do kill "$daemon" 2>/dev/null; done
  wait 2>/dev/null
  rm -rf "$place"
}
trap finish EXIT
mkdir -p "$place"/{state,spool}
free_port() { # two that nobody listens on
  for port in $(shuf -i 20000-60000 -n 50); do
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}
host=$(hostname -s)
cat >"$place/slurm.conf" <<CONF
ClusterName=glissade
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/none
CryptoType=crypto/none
CredType=cred/none
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=16 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
grep -q 'cred_none' <<<"$(ls "$plugins")" || sed -i '/^CredType/d' "$place/slurm.conf"
sed -i '/^CryptoType/d' "$place/slurm.conf"
export SLURM_CONF=$place/slurm.conf
slurmctld -D -c >"$place/slurmctld.out" 2>&1 & daemons+=($!)
slurmd -D -c >"$place/slurmd.out" 2>&1 & daemons+=($!)
for _ in $(seq 60); do
  scontrol show node "$host" 2>/dev/null | grep -q 'State=IDLE' && break
  sleep 0.5
done
if ! scontrol show node "$host" 2>/dev/null | grep -q 'State=IDLE'; then
  tail -n 5 "$place"/slurm*.log "$place"/slurm*.out 2>/dev/null
  skip "Slurm does not start here"
fi

cd "$place" || exit 1
values=500 tasks=8 # a task has a chunk of 1000 rows; continuous integration has twice as many
[ -z "${CI:-}" ] || values=1001 tasks=16
vary=(--set centerline.kind=straight --vary "body.friction_angle=10deg:25deg:$values" --vary track.finish.z=0m:1.5m:16)
"$program" sweep "$design" "${vary[@]}" -o one --quiet || exit 1
"$program" sweep --merge one -o one.csv --quiet || exit 1
many="all %j's" # quotes, spaces and replacements of Slurm in the names of logs
"$program" sweep "$design" "${vary[@]}" -o "$many" --slurm --quiet || exit 1
# What sbatch --wait asks less and less often, up to every half minute.
job=$(GLISSADE=$program sbatch --export=ALL --parsable "$many/sweep.sbatch") || exit 1
while squeue --noheader --jobs "$job" 2>/dev/null | grep -q .; do sleep 0.2; done
scontrol --oneliner show job "$job" >jobs || exit 1
[ "$(grep -c 'JobState=COMPLETED' jobs)" -eq $tasks ] || { cat jobs "$many"/slurm-*.log; exit 1; }
"$program" sweep --merge "$many" -o many.csv --quiet || exit 1
cmp one.csv many.csv || { echo "the rows differ"; exit 1; }
[ "$(ls "$many"/slurm-*.log | wc -l)" -eq $tasks ] || { echo "not $tasks tasks"; exit 1; }
echo "$tasks tasks of Slurm gave the $(($(wc -l <one.csv) - 1)) rows of one process, byte for byte"
