#include "baselines/pagmo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/algorithms/simulated_annealing.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

#include "error.hpp"
#include "stopwatch.hpp"

namespace kreisel::core::nest {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

const BaselineEntry& entry_of(Baseline baseline) {
  return *std::ranges::find(baselines, baseline, &BaselineEntry::baseline);
}

/// Ends a method of pagmo's from within.
struct Stopped {};

/// What pagmo copies about: the objective and the best seen lie elsewhere.
struct Box {
  Objective* objective = nullptr;
  BaselineResult* seen = nullptr;
  /// Called after each position that is asked for by itself; may throw Stopped.
  const std::function<void()>* on_single = nullptr;

  [[nodiscard]] std::size_t freedom() const {
    return objective ? static_cast<std::size_t>(objective->space().freedom()) : 1;
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(freedom(), 0.0), pagmo::vector_double(freedom(), 1.0)};
  }
  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& unit) const {
    const pagmo::vector_double cost = batch_fitness(unit);
    if (on_single && *on_single) (*on_single)();
    return cost;
  }
  [[nodiscard]] pagmo::vector_double batch_fitness(const pagmo::vector_double& units) const {
    const std::size_t n = units.size() / freedom(),
                      size = static_cast<std::size_t>(objective->space().size());
    std::vector<double> positions(n * size);
    for (std::size_t i = 0; i < n; ++i) {
      const std::span<double> x(&positions[i * size], size);
      objective->place({&units[i * freedom()], freedom()}, x);
      objective->project(x);
    }
    const std::vector<double> values = objective->values(positions, std::vector<double>(n, nothing));
    seen->evaluations += n;
    pagmo::vector_double costs;
    for (std::size_t i = 0; i < n; ++i) {
      costs.push_back(values[i] > nothing ? -values[i] : 1);
      if (!(values[i] > seen->value)) continue;
      seen->value = values[i];
      seen->best.assign(positions.data() + i * size, positions.data() + (i + 1) * size);
    }
    return costs;
  }
};

pagmo::algorithm one_generation(Baseline baseline, unsigned seed) {
  switch (baseline) {
    case Baseline::cmaes:
      // No tolerance at which to stop: a generation that is infeasible throughout has but one value.
      return pagmo::algorithm(
          pagmo::cmaes(1, -1, -1, -1, -1, 0.5, 0, 0, /*memory=*/true, /*force_bounds=*/true, seed));
    case Baseline::de:
      return pagmo::algorithm(pagmo::de(1, 0.8, 0.9, 2, 0, 0, seed));
    case Baseline::ga:
      return pagmo::algorithm(
          pagmo::sga(1, 0.9, 1, 0.02, 1, 2, "exponential", "polynomial", "tournament", seed));
    case Baseline::sa:  // has no generations: see anneal()
    case Baseline::pso:
      break;
  }
  pagmo::pso_gen method(1, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, /*memory=*/true, seed);
  method.set_bfe(pagmo::bfe{pagmo::member_bfe{}});
  return pagmo::algorithm(method);
}

/// All of it in one call, as pagmo's forgets its range and temperature at the end of one. It cools from where
/// a tenth of a scale less is accepted now and then to where the tolerance of scales is.
/// @param asked  positions at most
void anneal(pagmo::population& population, std::size_t asked, unsigned seed) {
  constexpr double first = 0.1, last = 1e-4;
  constexpr unsigned bin = 20;  // pagmo's own, for each number
  const std::size_t steps = asked / (bin * population.get_problem().get_nx());
  if (steps == 0) return;
  const pagmo::algorithm method(
      pagmo::simulated_annealing(first, last, static_cast<unsigned>(steps), 1, bin, 1.0, seed));
  try {
    population = method.evolve(population);
  } catch (const Stopped&) {
  }
}

}  // namespace

BaselineResult search_with_pagmo(Objective& objective, Baseline baseline, int particles, int iterations,
                                 std::uint64_t seed,
                                 const std::function<bool(double, std::uint64_t)>& on_generation) {
  const BaselineEntry& entry = entry_of(baseline);
  if (particles < entry.least_particles)
    throw InputError(fmt::format("{} with {} particles; expected at least {}", entry.name, particles,
                                 entry.least_particles));
  if (objective.space().freedom() == 0)
    throw InputError(
        fmt::format("{} with nothing free; expected a number, a direction or a rotation", entry.name));
  if (iterations < 0) throw InputError(fmt::format("iterations = {}; expected none or more", iterations));
  BaselineResult seen{{}, nothing, 0};
  const auto go_on = [&] { return !on_generation || on_generation(seen.value, seen.evaluations); };
  std::function<void()> on_single;
  const auto short_seed = static_cast<unsigned>(seed);
  const auto n = static_cast<std::size_t>(particles);
  const pagmo::problem problem(Box{&objective, &seen, &on_single});
  pagmo::population population(problem, pagmo::bfe{pagmo::member_bfe{}}, n, short_seed);
  if (baseline == Baseline::sa) {
    on_single = [&] {
      if (seen.evaluations % n == 0 && !go_on()) throw Stopped();
    };
    anneal(population, n * static_cast<std::size_t>(iterations), short_seed);
    return seen;
  }
  const pagmo::algorithm method = one_generation(baseline, short_seed);
  for (int i = 0; i < iterations; ++i) {
    population = method.evolve(population);
    if (!go_on()) break;
  }
  return seen;
}

OptimiseResult optimise_with_pagmo(const Nesting& nesting, device::Device& device, OptimiseSpec spec,
                                   const OnIteration& on_iteration) {
  const Baseline baseline = find_baseline(spec.variant).baseline;
  spec.variant = "hybrid";  // the scale of every placement is searched, and no search is given up
  // Deep points are a list, in which neighbours are no neighbours in space: no numbers to search over.
  spec.search.swarm.placing = Placing::anywhere;
  OptimiseResult result;
  const Stopwatch setup;
  const Asking asking = make_asking(nesting, device, spec);
  result.setup_seconds = setup.seconds();
  const Stopwatch search;
  SearchState& state = result.state;
  const SwarmOptions& swarm = spec.search.swarm;
  const BaselineResult found = search_with_pagmo(
      *asking.objective, baseline, swarm.particles, swarm.iterations, swarm.seed,
      [&](double value, std::uint64_t evaluations) {
        state.scale = std::max(value, 0.0);
        state.trace.push_back(
            {static_cast<int>(state.trace.size()), value, std::nan(""), std::nan(""), evaluations});
        result.ended_early = search.seconds() > spec.seconds || (on_iteration && !on_iteration(state));
        return !result.ended_early;
      });
  state.phase = SearchState::over;
  state.best = found.best;
  state.scale = std::max(found.value, 0.0);
  result.search_seconds = search.seconds();
  finish(result, asking);
  return result;
}

}  // namespace kreisel::core::nest
