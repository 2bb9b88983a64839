// stop.hpp - whether the work under way shall end, asked from deep within it.
#pragma once

#include <cstddef>
#include <stop_token>
#include <utility>

#include "control.hpp"

namespace kreisel::core {

/// While it lives, stop_here() asks this token: in the thread that made it, and in those that parallel_for()
/// starts from there. So loops of a mesh's size need not be handed a Control each. Whoever keeps what is done
/// so far when a stop is asked for, as a search does, has none around it.
class StopScope {
 public:
  explicit StopScope(std::stop_token stop) : before_(std::exchange(current(), std::move(stop))) {}
  ~StopScope() { current() = std::move(before_); }
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

  [[nodiscard]] static std::stop_token& current() {
    thread_local std::stop_token token;
    return token;
  }

 private:
  std::stop_token before_;
};

/// In a loop that may take longer than a second; costs no more than a look at a flag.
/// @throws Interrupted  a stop was asked for
inline void stop_here() {
  if (StopScope::current().stop_requested()) throw Interrupted();
}

/// The same in a loop whose steps take nanoseconds. @param step  counts them
inline void stop_here(std::size_t step) {
  if (step % 4096 == 0) stop_here();
}

}  // namespace kreisel::core
