#!/usr/bin/env bash
# What is too long for .ci/run: run before a release. long.sh [NAME ...]; without names all. Ends with a line for each.
set -uo pipefail
cd "$(dirname "$0")/.."
results=()
failed=0

# 200 mixed solves in eight threads under the thread sanitizer.
threads() {
  local build=build/tsan flags="-fsanitize=thread -g1 -O1 -fno-omit-frame-pointer"
  cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$flags" -DKREISEL_UNITY=ON -DKREISEL_TESTS=OFF -DKREISEL_MICRO=OFF &&
    cmake --build $build --target kreisel &&
    c++ $flags -std=c++20 -Ihost -isystem /usr/include/eigen3 tests/library/threads.cpp -o $build/threads -L$build -lkreisel \
      -Wl,-rpath,"$PWD/$build" &&
    TSAN_OPTIONS="suppressions=$PWD/tests/library/threads.supp ignore_noninstrumented_modules=1 halt_on_error=1 exitcode=66" $build/threads
}

# All tests under sanitizers, those of the programs too, but for what a browser, a slicer and CGAL make of files: that is
# the same without.
sanitized() {
  cmake --preset asan -B build/sanitized -DKREISEL_PROGRAMS=ON && cmake --build build/sanitized &&
    ASAN_OPTIONS=detect_leaks=0 ctest --test-dir build/sanitized -j2 --output-on-failure -E '^(apps/(page|outside|union):|library/)'
}

# A problem, a formulation and a solver of one's own, as the pages on extending add them.
extending() {
  cmake --preset dev -DKREISEL_PYTHON=ON && cmake --build --preset dev && tests/library/extending.py build/dev
}

# Experiments on a Slurm of this machine's own, with fifty kills.
slurm() { tests/cluster/slurm.sh build/dev 50; }

# What reads a sweep of 100000 records takes at most a minute and a gigabyte, each; KREISEL_SWEEP says another number.
sweep() { cmake --build build/dev --target bench synthetic_records && tests/cluster/sweep.sh build/dev "${KREISEL_SWEEP:-100000}"; }

# Do islands find more than seeds apart, in the same processor time? Are two nodes faster than one? (docs/cluster.md)
islands() { tests/cluster/islands.sh build/dev; }
two_nodes() { tests/cluster/two_nodes.sh build/dev; }

# Every reader fed by libFuzzer, for ten minutes each; KREISEL_FUZZ_SECONDS says otherwise. What it finds lies in
# build/fuzz/found: mend it, and add the file to tests/data/fuzz.
fuzz() {
  local build=build/fuzz seconds=${KREISEL_FUZZ_SECONDS:-600} wrong=0 reader
  cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS="-O1 -g1" -DKREISEL_FUZZ=ON \
      -DKREISEL_TESTS=OFF -DKREISEL_MICRO=OFF -DKREISEL_UNITY=ON || return 1
  for reader in ${KREISEL_FUZZ_READERS:-off obj ply stl 3mf experiment gcode}; do
    cmake --build $build --target "fuzz_$reader" || return 1
    mkdir -p "$build/corpus/$reader" "$build/found"
    ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 "$build/tests/fuzz/fuzz_$reader" -max_total_time="$seconds" -timeout=10 \
      -rss_limit_mb=2048 -max_len=16384 -print_final_stats=1 -artifact_prefix="$build/found/$reader-" \
      "$build/corpus/$reader" "tests/data/fuzz/$reader" || wrong=1
  done
  return $wrong
}

# The server of `design live` under a thousand hostile requests and tabs, and how long the page takes to follow a hand.
live() {
  cmake --build build/dev --target design && python3 tests/live/live_test.py build/dev/design 1000 && python3 tests/live/latency.py build/dev/design bunny 200
}

[ $# -gt 0 ] || set -- threads sanitized extending slurm sweep islands two_nodes live fuzz
for name; do
  began=$SECONDS
  if "$name"; then ending=passed; else ending=FAILED failed=1; fi
  results+=("long: $name $ending in $((SECONDS - began)) s")
done
printf '%s\n' "${results[@]}"
exit $failed
