// print.hpp - what `design` says.
#pragma once

#include "design/design.hpp"

namespace kreisel::core::apps {

void print_design(const Design& design);

}  // namespace kreisel::core::apps
