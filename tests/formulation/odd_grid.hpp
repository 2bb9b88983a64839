// odd_grid.hpp - a grid for kernel tests.
#pragma once

#include "domain/grid.hpp"

namespace kreisel::core {

/// Spacing and origin that single precision has to round.
inline Grid odd_grid() {
  Grid grid;
  grid.n = {61, 59, 53};
  grid.h = 0.0173;
  grid.origin = {-0.517, -0.43, 0.011};
  return grid;
}

}  // namespace kreisel::core
