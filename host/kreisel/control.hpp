// control.hpp - what the one who asks for long work keeps in hand: to be told of it, and to stop it.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "kreisel/error.hpp"

namespace kreisel {

/// Of one piece of work; the default tells nobody and never stops.
struct Control {
  std::stop_token stop = {};
  /// Told of each step as it begins, in the thread that asked. May be empty.
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
