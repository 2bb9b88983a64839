// stopwatch.hpp - wall seconds since it was made.
#pragma once

#include <chrono>

namespace kreisel::core {

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace kreisel::core
