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

[ $# -gt 0 ] || set -- threads
for name; do
  began=$SECONDS
  if "$name"; then ending=passed; else ending=FAILED failed=1; fi
  results+=("long: $name $ending in $((SECONDS - began)) s")
done
printf '%s\n' "${results[@]}"
exit $failed
