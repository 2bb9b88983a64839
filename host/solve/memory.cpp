#include "solve/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace kreisel {

Memory available_memory() {
  const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  const double machine = page * static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    double used_pages = 0;  // the first number of the file
    std::ifstream("/proc/self/statm") >> used_pages;
    const double left = std::max(static_cast<double>(limit.rlim_cur) - page * used_pages, 0.0);
    if (left < machine) return {left, "the limit on this process (ulimit -v) leaves"};
  }
  return {machine, "this machine has"};
}

}  // namespace kreisel
