// interrupt.hpp - Ctrl-C as a flag that long work asks for.
#pragma once

#include <stdexcept>

namespace kreisel {

/// From now on SIGINT and SIGTERM set the flag; a second one ends the program at once.
void catch_interrupts();

[[nodiscard]] bool interrupted();

/// Work was given up because the user asked for it. Nothing is wrong; programs exit with 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Between two steps of long work. @throws Interrupted  when the flag is set
void stop_if_interrupted();

}  // namespace kreisel
