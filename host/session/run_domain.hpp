// run_domain.hpp - the domain that a configuration asks for.
#pragma once

#include <optional>

#include "domain/exact.hpp"
#include "formulation/quadric.hpp"
#include "session/config.hpp"

namespace kreisel::core {

/// What of a body can be filled: voxels and the rays through them, or rays cut at the wall. One of the two.
struct RunDomain {
  std::optional<Columns> columns;
  std::optional<ExactColumns> exact;

  [[nodiscard]] const char* kind() const { return exact ? "exact" : "columns"; }
  [[nodiscard]] const Grid& grid() const { return exact ? exact->grid : columns->grid; }
  [[nodiscard]] double wall() const { return exact ? exact->wall : columns->wall; }
  [[nodiscard]] const Moments& interior() const { return exact ? exact->interior : columns->interior; }
  [[nodiscard]] Rays rays() const { return exact ? rays_of(*exact) : rays_of(*columns); }
};

}  // namespace kreisel::core
