#include "baselines/pagmo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

#include "error.hpp"
#include "unknown_name.hpp"

namespace kreisel::nest {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

struct Entry {
  std::string_view name;
  Baseline baseline;
  int least_particles;
};
constexpr std::array entries{Entry{"pagmo-pso", Baseline::pso, 2}, Entry{"pagmo-cmaes", Baseline::cmaes, 5},
                             Entry{"pagmo-de", Baseline::de, 5}};

const Entry& entry_of(Baseline baseline) { return *std::ranges::find(entries, baseline, &Entry::baseline); }

/// What pagmo copies about: the objective and the best seen lie elsewhere.
struct Box {
  Objective* objective = nullptr;
  BaselineResult* seen = nullptr;

  [[nodiscard]] std::size_t freedom() const {
    return objective ? static_cast<std::size_t>(objective->space().freedom()) : 1;
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(freedom(), 0.0), pagmo::vector_double(freedom(), 1.0)};
  }
  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& unit) const {
    return batch_fitness(unit);
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
      return pagmo::algorithm(
          pagmo::cmaes(1, -1, -1, -1, -1, 0.5, 1e-12, 1e-12, /*memory=*/true, /*force_bounds=*/true, seed));
    case Baseline::de:
      return pagmo::algorithm(pagmo::de(1, 0.8, 0.9, 2, 0, 0, seed));
    case Baseline::pso:
      break;
  }
  pagmo::pso_gen method(1, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, /*memory=*/true, seed);
  method.set_bfe(pagmo::bfe{pagmo::member_bfe{}});
  return pagmo::algorithm(method);
}

}  // namespace

Baseline parse_baseline(std::string_view text) {
  for (const Entry& entry : entries)
    if (entry.name == text) return entry.baseline;
  throw unknown_name("variant", text, names_of(entries));
}

std::string_view to_string(Baseline baseline) { return entry_of(baseline).name; }

BaselineResult search_with_pagmo(Objective& objective, Baseline baseline, int particles, int iterations,
                                 std::uint64_t seed,
                                 const std::function<bool(double, std::uint64_t)>& on_generation) {
  const Entry& entry = entry_of(baseline);
  if (particles < entry.least_particles)
    throw InputError(fmt::format("{} with {} particles; expected at least {}", entry.name, particles,
                                 entry.least_particles));
  if (objective.space().freedom() == 0)
    throw InputError(
        fmt::format("{} with nothing free; expected a number, a direction or a rotation", entry.name));
  if (iterations < 0) throw InputError(fmt::format("iterations = {}; expected none or more", iterations));
  BaselineResult seen{{}, nothing, 0};
  const auto short_seed = static_cast<unsigned>(seed);
  const pagmo::problem problem(Box{&objective, &seen});
  pagmo::population population(problem, pagmo::bfe{pagmo::member_bfe{}}, static_cast<std::size_t>(particles),
                               short_seed);
  const pagmo::algorithm method = one_generation(baseline, short_seed);
  for (int i = 0; i < iterations; ++i) {
    population = method.evolve(population);
    if (on_generation && !on_generation(seen.value, seen.evaluations)) break;
  }
  return seen;
}

}  // namespace kreisel::nest
