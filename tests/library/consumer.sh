#!/usr/bin/env bash
# Installs the build, and does what docs/library.md says: a consumer that needs Eigen alone, and the Python example.
# consumer.sh BUILD SOURCE [PYTHON]
set -euo pipefail
build=$1 source=$2 python=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

cmake --install "$build" --prefix "$prefix" > "$work/install.log" || { cat "$work/install.log"; exit 1; }

# The code of the document, by its language.
block() {  # LANGUAGE
  awk -v fence='```'"$1" '$0 == fence {on = 1; next} $0 == "```" {on = 0} on' "$source/docs/library.md"
}
mkdir "$work/top"
block cmake > "$work/top/CMakeLists.txt"
block cpp > "$work/top/top.cpp"
block c++ > "$work/top/problem.cpp"
block python > "$work/top/example.py"
printf '%s\n' 'add_executable(problem problem.cpp)' 'target_link_libraries(problem PRIVATE kreisel::kreisel)' >> "$work/top/CMakeLists.txt"
cmake -S "$work/top" -B "$work/top/build" -DCMAKE_PREFIX_PATH="$prefix" > "$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/top/build" > "$work/build.log" || { cat "$work/build.log"; exit 1; }

cd "$work/top"
env -u LD_LIBRARY_PATH build/top > out.txt
cat out.txt
grep -q '^1.2 mm: f = [0-9.]*, spins' out.txt
test -s top.stl
env -u LD_LIBRARY_PATH build/problem | tee problem.txt
grep -q '^20.00[0-9]* mm up$\|^19.99[0-9]* mm up$' problem.txt
if build/top no-such-file.off 2> error.txt; then echo "a file that is not there was read"; exit 1; fi
test "$(wc -l < error.txt)" -eq 1
env -u LD_LIBRARY_PATH "$prefix/bin/bench" --version
"$prefix/libexec/kreisel/nest_baseline" --help > /dev/null  # which users do not call

if [ -n "$python" ]; then
  PYTHONPATH=$prefix/lib/python3/dist-packages env -u LD_LIBRARY_PATH "$python" example.py
fi
