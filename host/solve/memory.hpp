// memory.hpp - how much this process may have.
#pragma once

#include <stdexcept>

namespace kreisel {

/// What was asked is fine, but there is no memory for it. Programs print what() and exit with 4.
class MemoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Memory {
  double bytes;    ///< that may be asked for
  const char* of;  ///< whose they are, for a message that goes on with the number: "this machine has"
};

/// The machine's memory, or what the limit on address space (ulimit -v) leaves where that is less.
[[nodiscard]] Memory available_memory();

}  // namespace kreisel
