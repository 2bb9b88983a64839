// pagmo.hpp - pagmo2's searches on the same objective, to compare ours with.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "nest/search/baseline.hpp"
#include "nest/search/objective.hpp"
#include "nest/search/optimise.hpp"

namespace kreisel::core::nest {

struct BaselineResult {
  std::vector<double> best;  ///< a position; empty when nothing asked for was feasible
  double value;              ///< minus infinity then
  std::uint64_t evaluations;
};

/// Maximises over the box [0,1]^freedom() that Objective::place makes positions of. An infeasible position
/// counts as -1, under every scale. Floors are minus infinity: pagmo has no use for a search given up early.
/// `particles` random positions are where it starts, and as many are asked for in a generation; annealing
/// starts from the best of them, asks for one after the other, and every `particles` of them are called a
/// generation, the last ones of which it may leave out: it cools in whole steps.
///
/// @param on_generation  told the best value and the evaluations so far; false ends the search
/// @throws InputError    fewer particles than the method needs (BaselineEntry), or nothing free
[[nodiscard]] BaselineResult search_with_pagmo(
    Objective& objective, Baseline baseline, int particles, int iterations, std::uint64_t seed,
    const std::function<bool(double, std::uint64_t)>& on_generation);

/// optimise() by the baseline that `spec.variant` names: on the largest scale at each placement, with the
/// swarm's particles, iterations and seed. There is nothing to resume: a state that it returns ends the
/// search.
///
/// @throws InputError  no baseline's name, or as search_with_pagmo()
[[nodiscard]] OptimiseResult optimise_with_pagmo(const Nesting& nesting, device::Device& device,
                                                 OptimiseSpec spec, const OnIteration& on_iteration = {});

}  // namespace kreisel::core::nest
