#!/usr/bin/env bash
# Experiments submitted to a Slurm of this machine's own (cluster.sh).   slurm.sh BUILD [KILLS] [short]
# While sweeps of runs are at work, tasks are killed KILLS times in all (default 3), at random moments: two times of three
# a task, else the whole of a node's slurmd. Every record must be there once, whole, and the same as a run without a
# cluster makes it. Then a search is told that its time is over: it is queued again, goes on, and finds what it finds alone.
# `short` is of smaller runs and a shorter search, for ctest.
set -euo pipefail
build=$(cd "$1" && pwd)
kills=${2:-3}
case "${3:-}" in
  "") models='"ellipsoid", "bird", "heart"' resolutions='56, 60, 64, 68' particles=40 iterations=80 runs=12 ;;
  short) models='"ellipsoid", "bird"' resolutions='40, 44, 48' particles=12 iterations=30 runs=6 ;;
  *) echo "slurm.sh: '$3'; expected short, or nothing" >&2; exit 2 ;;
esac
. "$(dirname "$0")/cluster.sh"

cat > "$at/sweep.toml" <<TOML
title = "a sweep"
part = "none"
[[run]]
model = [$models]
resolution = [$resolutions]
formulation = "rayrep"
TOML
cat > "$at/search.toml" <<TOML
title = "a search"
table = "nestings"
[[run]]
outer = "heart"
free = "all"
particles = $particles
iterations = $iterations
exchange = 1          # an island alone: its checkpoint is written at every iteration, and stays
TOML
"$build/bench" run "$at/sweep.toml" --results "$at/alone" >"$at/alone.txt" 2>&1

# --- each record once, whole, the same
whole() {  # RESULTS
  local count
  "$build/bench" watch "$at/sweep.toml" --results "$1"
  count=$(find "$1/sweep" -name '*.h5' | wc -l)
  [ "$count" = $runs ] || { echo "slurm.sh: $count records; expected $runs" >&2; exit 1; }
  [ -z "$(find "$1/sweep" -maxdepth 1 -type f ! -name '*.h5' ! -name '*.tmp')" ] || { echo "slurm.sh: something half-written is left" >&2; exit 1; }
  "$build/bench" show "$1/sweep" --columns model,resolution,objective --json "$at/there.json" >/dev/null
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
}

# --- kill at random, over as many sweeps as it takes
kill_one() {  # NUMBER
  if [ $(($1 % 3)) -eq 2 ]; then
    local node=$([ $((RANDOM % 2)) -eq 0 ] && echo one || echo two)
    pkill -9 -P "$(cat "$at/node-$node.pid")" 2>/dev/null || true
    kill -9 "$(cat "$at/node-$node.pid")" 2>/dev/null || true
    pkill -9 -f "bench run '?$at/sweep.toml" 2>/dev/null || true
    sleep 1
    start_node "$node"
  else
    local victim
    victim=$(pgrep -f "bench run $at/sweep.toml" | shuf -n 1)
    [ -n "$victim" ] && kill -9 "$victim" 2>/dev/null
  fi
}
finished() { ! "$build/bench" run "$at/sweep.toml" --results "$1" --dry-run | grep -q '^to run'; }
submit() { "$build/bench" submit "$at/sweep.toml" --slurm --tasks 4 --results "$1" >/dev/null; }
killed=0 sweeps=0
until [ $sweeps -gt 0 ] && [ $killed -ge "$kills" ]; do
  sweeps=$((sweeps + 1))
  results="$at/results/$sweeps"
  submit "$results"
  for round in $(seq 60); do
    while [ $killed -lt "$kills" ] && ! over; do
      sleep "0.$((RANDOM % 9 + 1))"
      if kill_one $killed; then killed=$((killed + 1)); fi
    done
    wait_for 300 over
    finished "$results" && break
    submit "$results"
  done
  whole "$results"
done
echo "slurm.sh: $((runs * sweeps)) records of $((runs * sweeps)) in $sweeps sweeps, $killed kills, none lost or doubled, objectives as without a cluster"

# --- out of time, as Slurm says it a minute before
wait_for 60 idle
"$build/bench" submit "$at/search.toml" --slurm --tasks 1 --results "$at/results" >/dev/null
kept() { [ -n "$(find "$at/results/search" -name '*.checkpoint')" ]; }
wait_for 60 kept
job=$(squeue -h -o %A | head -n 1)
scancel --batch --signal=USR1 "$job"
sleep 2
wait_for 300 over
"$build/bench" watch "$at/search.toml" --results "$at/results"
scontrol show job "$job" | grep -q 'Restarts=1 ' || { echo "slurm.sh: the search was not queued again" >&2; exit 1; }
"$build/bench" run "$at/search.toml" --results "$at/alone" >>"$at/alone.txt" 2>&1
for results in "$at/results" "$at/alone"; do
  "$build/bench" show "$results/search" --columns scale,evaluations
done | sort | uniq -c | grep -q '^ *1 [ 0-9]' && { echo "slurm.sh: another scale than without a cluster" >&2; exit 1; }
echo "slurm.sh: a search out of time was queued again, went on from its checkpoint, and found what it finds alone"
