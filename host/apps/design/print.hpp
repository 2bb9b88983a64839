// print.hpp - what `design` says.
#pragma once

#include "design/design.hpp"

namespace kreisel::core::apps {

void print_design(const Design& design);

/// The printers that are known.
void print_printers();

}  // namespace kreisel::core::apps
