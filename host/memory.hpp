// memory.hpp - how much this process may have, and the exception for when that is too little.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace kreisel::core {

/// What was asked is fine, but there is no memory for it. Programs print what() and exit with 4.
class MemoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Memory {
  double bytes;    ///< that may be asked for
  bool limited;    ///< by ulimit -v: what is asked for counts, used or not
  const char* of;  ///< whose they are, for a message that goes on with the number: "this machine has"
};

/// The machine's memory, or what the limit on address space (ulimit -v) leaves where that is less.
[[nodiscard]] inline Memory available_memory() {
  const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  const double machine = page * static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    double used_pages = 0;  // the first number of the file
    std::ifstream("/proc/self/statm") >> used_pages;
    const double left = std::max(static_cast<double>(limit.rlim_cur) - page * used_pages, 0.0);
    if (left < machine) return {left, true, "the limit on this process (ulimit -v) leaves"};
  }
  return {machine, false, "this machine has"};
}

/// The most memory that this process has had in use so far.
[[nodiscard]] inline double peak_memory() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * static_cast<double>(usage.ru_maxrss) : 0.0;
}

}  // namespace kreisel::core
