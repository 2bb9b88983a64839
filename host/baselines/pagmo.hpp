// pagmo.hpp - pagmo2's searches on the same objective, to compare ours with.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "nest/objective.hpp"

namespace kreisel::nest {

/// Particle swarm with constriction and a local topology; covariance matrix adaptation; differential
/// evolution: pagmo's pso_gen, cmaes and de, at pagmo's own settings.
enum class Baseline { pso, cmaes, de };

/// @throws InputError  not one of pagmo-pso, pagmo-cmaes, pagmo-de
[[nodiscard]] Baseline parse_baseline(std::string_view text);
[[nodiscard]] std::string_view to_string(Baseline baseline);

struct BaselineResult {
  std::vector<double> best;  ///< a position; empty when nothing asked for was feasible
  double value;              ///< minus infinity then
  std::uint64_t evaluations;
};

/// Maximises over the box [0,1]^freedom() that Objective::place makes positions of. An infeasible position
/// counts as -1, under every scale. Floors are minus infinity: pagmo has no use for a search given up early.
///
/// @param on_generation  told the best value and the evaluations so far; false ends the search
/// @throws InputError    fewer particles than the method needs (de 5, cmaes 5, pso 2), or nothing free
[[nodiscard]] BaselineResult search_with_pagmo(
    Objective& objective, Baseline baseline, int particles, int iterations, std::uint64_t seed,
    const std::function<bool(double, std::uint64_t)>& on_generation);

}  // namespace kreisel::nest
