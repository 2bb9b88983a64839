// run_bench.hpp - `bench` as a user runs it.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

#include "places.hpp"

namespace kreisel::core {

struct BenchAnswer {
  int code;
  std::string out;  ///< standard output and error together
};

/// Runs a line of shell.
inline BenchAnswer shell(const std::string& line) {
  // PoCL and its LLVM keep memory until the end: not what these tests are about.
  const std::string command =
      fmt::format("export ASAN_OPTIONS=detect_leaks=0\n( {}\n) 2>&1 </dev/null", line);
  std::FILE* pipe = popen(command.c_str(), "r");
  BenchAnswer answer{-1, {}};
  std::array<char, 4096> block;
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), pipe))
    answer.out.append(block.data(), n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

/// The shell line that starts `bench`, waits until `ready` holds, sends it one SIGINT and ends as it does.
inline std::string interrupted_when(const std::string& arguments, const std::string& ready) {
  return fmt::format(
      "'{}' {} & pid=$!; n=0; until {} || [ $n -ge 600 ]; do sleep 0.1; n=$((n+1)); done\n"
      "kill -INT $pid; wait $pid",
      bench_program, arguments, ready);
}

/// @param before  shell ahead of the program's name: variables, or commands that end in ;
inline BenchAnswer bench(const std::string& arguments, const std::string& before = "") {
  return shell(fmt::format("{} '{}' {}", before, bench_program, arguments));
}

}  // namespace kreisel::core
