#!/usr/bin/env bash
# Installs the build, and does what docs/library.md says: a consumer that needs Eigen alone, and the Python example.
# consumer.sh BUILD SOURCE [PYTHON]
set -euo pipefail
build=$1 source=$2 python=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

cmake --install "$build" --prefix "$prefix" > "$work/install.log" || { cat "$work/install.log"; exit 1; }

# The code of a document, by its language.
block() {  # LANGUAGE [PAGE]
  awk -v fence='```'"$1" '$0 == fence {on = 1; next} $0 == "```" {on = 0} on' "$source/docs/${2:-library.md}"
}
mkdir "$work/top"
block cmake > "$work/top/CMakeLists.txt"
block cpp > "$work/top/top.cpp"
block c++ > "$work/top/problem.cpp"
block python > "$work/top/example.py"
block python tutorials/problem.md > "$work/top/tutorial.py"
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
for program in bench design; do grep -q "^.TH" "$prefix/share/man/man1/$program.1"; done

if [ -n "$python" ]; then
  PYTHONPATH=$prefix/lib/python3/dist-packages env -u LD_LIBRARY_PATH "$python" example.py
  PYTHONPATH=$prefix/lib/python3/dist-packages env -u LD_LIBRARY_PATH "$python" tutorial.py | tee tutorial.txt
  grep -q '^0.38 optimal Verdict(swings in 0.3800 s with 65' tutorial.txt
  grep -q '^0.45 infeasible' tutorial.txt
fi
