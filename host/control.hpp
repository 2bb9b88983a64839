// control.hpp - what the one who asks for long work keeps in hand: to be told of it, and to stop it.
#pragma once

#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>

namespace kreisel {

/// Work was given up because the user asked for it. Nothing is wrong, and nothing is half-written; programs
/// exit with 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Of one piece of work; the default tells nobody and never stops.
struct Control {
  std::stop_token stop = {};
  /// Told of each step as it begins, for progress on a terminal. May be empty.
  std::function<void(const std::string& step)> progress = {};

  void tell(const std::string& step) const {
    if (progress) progress(step);
  }
  [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
  /// Between two steps. @throws Interrupted  when a stop was asked for
  void stop_if_asked() const {
    if (stopped()) throw Interrupted();
  }
};

}  // namespace kreisel
