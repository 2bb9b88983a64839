// nest_print.hpp - layers and landscapes in words.
#pragma once

#include "run/nest_run.hpp"

namespace kreisel::core::bench {

void print_layers(const NestResult& result);
void print_landscape(const NestResult& result);

}  // namespace kreisel::core::bench
