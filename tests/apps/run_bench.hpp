// run_bench.hpp - `bench` as a user runs it.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace kreisel {

struct BenchAnswer {
  int code;
  std::string out;  ///< standard output and error together
};

inline BenchAnswer bench(const std::string& arguments) {
  // PoCL and its LLVM keep memory until the end: not what these tests are about.
  const std::string command =
      fmt::format("ASAN_OPTIONS=detect_leaks=0 '{}' {} 2>&1 </dev/null", KREISEL_BENCH, arguments);
  std::FILE* pipe = popen(command.c_str(), "r");
  BenchAnswer answer{-1, {}};
  std::array<char, 4096> block;
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), pipe))
    answer.out.append(block.data(), n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

}  // namespace kreisel
