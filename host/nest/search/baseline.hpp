// baseline.hpp - searches of another library, to compare ours with; by name alone, so that a configuration
// can hold one.
#pragma once

#include <array>
#include <string_view>

namespace kreisel::core::nest {

/// Particle swarm with constriction and a local topology; covariance matrix adaptation; differential
/// evolution; a genetic algorithm; simulated annealing: pagmo2's pso_gen, cmaes, de, sga and
/// simulated_annealing, at pagmo's own settings but for temperatures, which are those of scales,
/// and tolerances at which CMA-ES would stop, which it has none of.
enum class Baseline { pso, cmaes, de, ga, sa };

struct BaselineEntry {
  std::string_view name;
  Baseline baseline;
  int least_particles;  ///< that the method needs
};
inline constexpr std::array baselines{
    BaselineEntry{"pagmo-pso", Baseline::pso, 2}, BaselineEntry{"pagmo-cmaes", Baseline::cmaes, 5},
    BaselineEntry{"pagmo-de", Baseline::de, 5}, BaselineEntry{"pagmo-ga", Baseline::ga, 2},
    BaselineEntry{"pagmo-sa", Baseline::sa, 1}};

[[nodiscard]] constexpr bool is_baseline(std::string_view variant) { return variant.starts_with("pagmo-"); }

/// @throws InputError  none of their names
[[nodiscard]] const BaselineEntry& find_baseline(std::string_view name);

}  // namespace kreisel::core::nest
