#!/usr/bin/env bash
# What looks at a sweep of many records, in seconds and memory.   sweep.sh BUILD [RECORDS] [FOLDER]
# Records are synthetic (synthetic_records.cpp), as large as those of small solves; where FOLDER has them already, they are
# taken. Each look is to take a minute and a gigabyte at most.
set -euo pipefail
build=$(cd "$1" && pwd)
records=${2:-100000}
at=$(mktemp -d)
trap 'rm -rf "$at"' EXIT
folder=${3:-$at/results}

# Ten models, five resolutions, two formulations, and as many weights as it takes.
cat > "$at/sweep.toml" <<TOML
title = "a sweep"
[[run]]
model = ["ellipsoid", "bird", "spheres", "kitten", "duck", "cuboid", "heart", "arrow-heart", "teapot", "skull"]
resolution = [32, 40, 48, 56, 64]
formulation = ["rayrep", "voxel"]
set.problem.lambda = [$(seq -s, $((records / 100)))]
TOML
[ -d "$folder/sweep" ] || "$build/tests/synthetic_records" "$at/sweep.toml" "$folder"

failed=0
look() {  # NAME COMMAND...
  local name=$1; shift
  /usr/bin/time -o "$at/took" -f '%e %U %S %M' "$@" >"$at/out" || { cat "$at/out"; failed=1; }
  read -r wall user system kilobytes < "$at/took"
  local verdict=within
  if [ "$(echo "$wall > 60 || $kilobytes > 1000000" | bc)" = 1 ]; then verdict=ABOVE failed=1; fi
  printf 'sweep.sh: %-22s %6.1f s (processor %6.1f s), %4.0f MB: %s a minute and a gigabyte\n' \
    "$name" "$wall" "$(echo "$user + $system" | bc)" "$(echo "$kilobytes / 1000" | bc)" $verdict
}
echo "sweep.sh: $(find "$folder/sweep" -name '*.h5' | wc -l) records, $(du -sm "$folder/sweep" | cut -f 1) MB"
look "what is finished" "$build/bench" run "$at/sweep.toml" --results "$folder" --dry-run
look "watch" "$build/bench" watch "$at/sweep.toml" --results "$folder"
look "show" "$build/bench" show "$folder/sweep"
look "show --columns" "$build/bench" show "$folder/sweep" --columns model,grid,objective,seconds
look "run and its table" "$build/bench" run "$at/sweep.toml" --results "$folder"
look "report" "$build/bench" report "$at/sweep.toml" --results "$folder" -o "$at/report.html"
exit $failed
