# A Slurm of this machine's own, without systemd: two virtual nodes, one and two, of one core each. Source it with
# `build` set; it sets `at`, a folder that is gone in the end, and says why where no Slurm can be started (exit 77).
# Needs slurmctld, slurmd, munge, and root.
not_here() { echo "$(basename "$0"): $*; skipped" >&2; exit 77; }
for program in munged slurmctld slurmd sbatch squeue; do
  command -v "$program" >/dev/null && continue
  [ -z "${KREISEL_CI:-}" ] || { echo "$(basename "$0"): $program is missing, which CI installs" >&2; exit 1; }
  not_here "$program is not installed (setup.sh --ci does it)"
done
[ "$(id -u)" -eq 0 ] || not_here "slurmd needs root"

at=$(mktemp -d)
started=()
finish() {
  for process in $(cat "$at"/*.pid 2>/dev/null) "${started[@]}"; do kill -9 "$process" 2>/dev/null || true; done
  pkill -9 -f "bench run $at/" 2>/dev/null || true
  rm -rf "$at"
}
trap finish EXIT

mkdir -p "$at"/{munge,state,results}
dd if=/dev/urandom bs=1 count=1024 of="$at/munge/key" status=none
chmod 700 "$at/munge"; chmod 400 "$at/munge/key"; chmod 755 "$at"
munged --force --foreground --key-file="$at/munge/key" --socket="$at/munge/socket" --pid-file="$at/munge.pid" \
  --log-file="$at/munge/log" --seed-file="$at/munge/seed" >"$at/munged.out" 2>&1 &
started+=($!); disown
port=$((20000 + RANDOM % 20000))
export SLURM_CONF="$at/slurm.conf"
cat > "$SLURM_CONF" <<CONF
ClusterName=two
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$at/munge/socket,cred_expire=5
SlurmUser=root
SlurmctldPidFile=$at/slurmctld.pid
SlurmdPidFile=$at/slurmd-%n.pid
SlurmdSpoolDir=$at/spool-%n
StateSaveLocation=$at/state
SlurmctldLogFile=$at/slurmctld.log
SlurmdLogFile=$at/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdTimeout=10
ReturnToService=2
SchedulerParameters=sched_interval=1,bf_interval=1
NodeName=one,two NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=1 State=UNKNOWN
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
PartitionName=first Nodes=one MaxTime=INFINITE State=UP
CONF
wait_for() {  # SECONDS COMMAND...
  local until=$((SECONDS + $1)); shift
  until "$@"; do
    [ $SECONDS -lt $until ] || { echo "$(basename "$0"): waited in vain for: $*" >&2; squeue >&2; tail -n 5 "$at"/*.log >&2; exit 1; }
    sleep 0.3
  done
}
wait_here() {  # as wait_for, of what a machine may not allow
  (wait_for "$@") || not_here "no Slurm can be started here"
}
# Each node has a core of its own, where there are two.
start_node() {
  local core=$([ "$1" = two ] && [ "$(nproc)" -gt 1 ] && echo 1 || echo 0)
  taskset -c "$core" slurmd -N "$1" -f "$SLURM_CONF" -D >>"$at/slurmd-$1.out" 2>&1 &
  started+=($!); echo $! > "$at/node-$1.pid"; disown
}
wait_here 10 test -S "$at/munge/socket"
slurmctld -f "$SLURM_CONF" -D >"$at/slurmctld.out" 2>&1 &
started+=($!); disown
start_node one; start_node two
idle() { [ "$(sinfo -h -N -p all -o %T 2>/dev/null | grep -c idle)" = 2 ]; }
wait_here 60 idle
over() { [ -z "$(squeue -h)" ]; }
