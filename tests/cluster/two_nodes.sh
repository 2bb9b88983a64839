#!/usr/bin/env bash
# How much faster are two nodes than one?   two_nodes.sh BUILD [EXPERIMENT]
# The experiment (default solver_settings) as a job on one virtual node of one core, then on two, each pinned to a core of
# its own; wall time, and processor time of the tasks as the kernel counts it. Ends with their ratio.
set -euo pipefail
build=$(cd "$1" && pwd)
experiment=${2:-solver_settings}
. "$(dirname "$0")/cluster.sh"
name=$(basename "$experiment" .toml)

measure() {  # PARTITION
  local results="$at/results/$1" began ended
  local folder="$results/$name/slurm"
  # Each compiles its kernels anew, or the second would find those of the first.
  export TMPDIR="$at/tmp-$1" XDG_CACHE_HOME="$at/cache-$1"
  mkdir -p "$folder" "$TMPDIR" "$XDG_CACHE_HOME"
  "$build/bench" submit "$experiment" --slurm --tasks 16 --partition "$1" --results "$results" --dry-run > "$folder/job.sh"
  # Of what the shell has waited for; a pipe would be another shell, which has waited for nothing.
  echo "times > '$folder/'\"\$SLURM_ARRAY_TASK_ID.times\"" >> "$folder/job.sh"
  began=$(date +%s.%N)
  sbatch --output="$folder/%a.txt" "$folder/job.sh" >/dev/null
  wait_for 14400 over
  ended=$(date +%s.%N)
  "$build/bench" watch "$experiment" --results "$results" >&2
  tail -qn 1 "$folder"/*.times | awk -v wall="$(echo "$ended - $began" | bc)" '
    { for (i = 1; i <= 2; ++i) { split($i, t, "m"); spent += 60 * t[1] + t[2] } } END { print wall, spent }'
}
read -r one_wall one_spent <<<"$(measure first)"
read -r two_wall two_spent <<<"$(measure all)"
printf 'two_nodes.sh: %s: one node %.0f s (processor %.0f s), two nodes %.0f s (processor %.0f s), ratio %.2f\n' \
  "$name" "$one_wall" "$one_spent" "$two_wall" "$two_spent" "$(echo "$two_wall / $one_wall" | bc -l)"
