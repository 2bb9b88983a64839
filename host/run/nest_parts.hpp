// nest_parts.hpp - what every kind of nesting run makes of its configuration.
#pragma once

#include <vector>

#include "nest/decide/nesting.hpp"
#include "nest/search/optimise.hpp"
#include "run/nest_run.hpp"

namespace kreisel::core {

/// Outer, inner, and what is within; a shape in itself once. Any mesh will do: none is checked or mended.
/// @throws InputError  unknown model, unreadable file, a mesh without extent that is to be scaled
[[nodiscard]] std::vector<TriangleMesh> shapes_of_run(const NestConfig& config);

/// Rotation, plane and directions as configured; centroid and plane at the origin, scale 1.
[[nodiscard]] nest::Placement unplaced(const NestTurn& turn);

/// The search as configured, but for what is given and kept out: those need a nesting.
[[nodiscard]] nest::OptimiseSpec search_of(const NestSearch& search, const NestDecision& decision);

/// A run of layers, and of outlines. As run_nest().
[[nodiscard]] NestResult run_layers(const NestConfig& config, const NestHooks& hooks);
[[nodiscard]] NestResult run_landscape(const NestConfig& config, const NestHooks& hooks);

}  // namespace kreisel::core
