// interrupt.hpp - Ctrl-C as a flag that long work asks for.
#pragma once

namespace kreisel {

/// From now on SIGINT and SIGTERM set the flag; a second one ends the program at once.
void catch_interrupts();

[[nodiscard]] bool interrupted();

}  // namespace kreisel
