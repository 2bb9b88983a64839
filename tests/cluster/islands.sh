#!/usr/bin/env bash
# Do islands find more than the same searches apart?   islands.sh BUILD [GROUPS] [SEEDS]
# GROUPS times (default 10) SEEDS searches (default 4) of different seeds, all of a group at once, once as islands and once
# apart: the same number of iterations of as many particles. Ends with the best scale of each group, and how many groups
# of islands did better.
set -euo pipefail
build=$(cd "$1" && pwd)
groups=${2:-10}
seeds=${3:-4}
at=$(mktemp -d)
trap 'rm -rf "$at"' EXIT

search() {  # GROUP EXCHANGE: the best scale of the group, evaluations and seconds of search of all
  local name="g$1-e$2" first=$(($1 * seeds + 1)) shard
  cat > "$at/$name.toml" <<TOML
title = "islands"
table = "nestings"
[[run]]
outer      = "${KREISEL_OUTER:-heart}"
free       = "all"
particles  = ${KREISEL_PARTICLES:-40}
iterations = ${KREISEL_ITERATIONS:-100}
exchange   = $2
seed       = [$(seq -s, $first $((first + seeds - 1)))]
TOML
  for shard in $(seq "$seeds"); do
    "$build/bench" run "$at/$name.toml" --results "$at" --shard "$shard/$seeds" >"$at/$name-$shard.txt" 2>&1 &
  done
  wait
  "$build/bench" show "$at/$name" --columns scale,evaluations,seconds.search --json - | /usr/bin/python3 -c '
import json, sys
runs = json.load(sys.stdin)
print(max(r["scale"] for r in runs), sum(r["evaluations"] for r in runs), sum(r["seconds.search"] for r in runs))'
}
for group in $(seq 0 $((groups - 1))); do
  echo "$(search "$group" 0) $(search "$group" "${KREISEL_EXCHANGE:-10}")" | tee -a "$at/all" |
    awk -v group="$group" '{ printf "islands.sh: group %d: apart %.5f, islands %.5f\n", group, $1, $4 }'
done
awk '{ apart += $1; islands += $4; better += $4 > $1 + 1e-4; worse += $4 < $1 - 1e-4; asked += $2; of += $5; s += $3; t += $6 }
  END { printf "islands.sh: %d groups: best apart %.5f, of islands %.5f on average; islands better in %d, worse in %d; " \
               "evaluations %d and %d, %.0f s and %.0f s\n", NR, apart / NR, islands / NR, better, worse, asked, of, s, t }' "$at/all"
