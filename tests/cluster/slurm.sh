#!/usr/bin/env bash
# A Slurm of this machine's own, without systemd, and an experiment submitted to it.   slurm.sh BUILD [KILLS]
# Two virtual nodes of one core each. While the job runs, tasks are killed KILLS times (default 3), at random moments
# and in turn by a kill -9 of the task and of the whole of a node's slurmd; every record must be there once, whole, and
# the same as a run without a cluster makes it. Needs slurmctld, slurmd, munge, and root. Ends with a line of what it saw.
set -euo pipefail
build=$(cd "$1" && pwd)
kills=${2:-3}
source=$(cd "$(dirname "$0")/../.." && pwd)
for program in munged slurmctld slurmd sbatch squeue; do
  command -v "$program" >/dev/null || { echo "slurm.sh: $program is not installed; skipped" >&2; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "slurm.sh: slurmd needs root; skipped" >&2; exit 77; }

at=$(mktemp -d)
started=()
finish() {
  for process in $(cat "$at"/*.pid 2>/dev/null) "${started[@]}"; do kill -9 "$process" 2>/dev/null || true; done
  rm -rf "$at"
}
trap finish EXIT

# --- the cluster
mkdir -p "$at"/{munge,state,spool1,spool2,results}
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
CONF
wait_for() {  # SECONDS COMMAND...
  local until=$((SECONDS + $1)); shift
  until "$@"; do [ $SECONDS -lt $until ] || { echo "slurm.sh: waited in vain for: $*" >&2; squeue >&2; tail -n 5 "$at"/*.log >&2; exit 1; }; sleep 0.3; done
}
start_node() { slurmd -N "$1" -f "$SLURM_CONF" -D >>"$at/slurmd-$1.out" 2>&1 & started+=($!); echo $! > "$at/node-$1.pid"; disown; }
wait_for 10 test -S "$at/munge/socket"
slurmctld -f "$SLURM_CONF" -D >"$at/slurmctld.out" 2>&1 &
started+=($!); disown
start_node one; start_node two
idle() { [ "$(sinfo -h -N -o %T 2>/dev/null | grep -c idle)" = 2 ]; }
wait_for 60 idle

# --- what is to be run: twelve runs of a second or two, each of a name of its own
cat > "$at/sweep.toml" <<TOML
title = "a sweep"
part = "none"
[[run]]
model = ["ellipsoid", "bird", "heart"]
resolution = [56, 60, 64, 68]
formulation = "rayrep"
TOML
"$build/bench" run "$at/sweep.toml" --results "$at/alone" >"$at/alone.txt" 2>&1
"$build/bench" submit "$at/sweep.toml" --slurm --tasks 4 --results "$at/results"

# --- kill at random
over() { [ -z "$(squeue -h)" ]; }
killed=0
while [ $killed -lt "$kills" ] && ! over; do
  sleep "0.$((RANDOM % 9 + 1))"
  if [ $((killed % 3)) -eq 2 ]; then
    node=$([ $((RANDOM % 2)) -eq 0 ] && echo one || echo two)
    pkill -9 -P "$(cat "$at/node-$node.pid")" 2>/dev/null || true
    kill -9 "$(cat "$at/node-$node.pid")" 2>/dev/null || true
    pkill -9 -f "bench run '?$at/sweep.toml" 2>/dev/null || true
    sleep 1
    start_node "$node"
  else
    victim=$(pgrep -f "bench run $at/sweep.toml" | shuf -n 1) || continue
    kill -9 "$victim" 2>/dev/null || continue
  fi
  killed=$((killed + 1))
done
for round in 1 2 3 4 5 6; do
  wait_for 300 over
  "$build/bench" run "$at/sweep.toml" --results "$at/results" --dry-run | grep -q '^to run' || break
  "$build/bench" submit "$at/sweep.toml" --slurm --tasks 4 --results "$at/results" >/dev/null
done

# --- each record once, whole, the same
"$build/bench" watch "$at/sweep.toml" --results "$at/results"
count=$(find "$at/results/sweep" -name '*.h5' | wc -l)
[ "$count" = 12 ] || { echo "slurm.sh: $count records; expected 12" >&2; exit 1; }
[ -z "$(find "$at/results/sweep" -maxdepth 1 -type f ! -name '*.h5')" ] || { echo "slurm.sh: something half-written is left" >&2; exit 1; }
"$build/bench" show "$at/results/sweep" --columns model,resolution,objective --json "$at/there.json" >/dev/null
"$build/bench" show "$at/alone/sweep" --columns model,resolution,objective --json "$at/here.json" >/dev/null
# To 1e-6, Ipopt's own tolerance being 1e-5: sums over rays go by the number of threads.
/usr/bin/python3 - "$at/there.json" "$at/here.json" <<'PY'
import json, sys
def objectives(file):
    return {(r["model"], r["resolution"]): r["objective"] for r in json.load(open(file))}
there, here = map(objectives, sys.argv[1:])
wrong = [k for k in here if k not in there or not abs(there[k] - here[k]) <= 1e-6 * abs(here[k])]
if wrong or len(there) != len(here):
    sys.exit(f"slurm.sh: other objectives than without a cluster: {wrong}")
PY
echo "slurm.sh: 12 records of 12, $killed kills, none lost or doubled, objectives as without a cluster"
