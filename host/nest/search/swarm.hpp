// swarm.hpp - particle swarms: a population that moves by momentum and by what it and its neighbours found.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nest/search/objective.hpp"

namespace kreisel::core::nest {

/// Whose best a particle is drawn to: anyone's, its two neighbours' on a ring, its four on a torus, or that
/// of a few others, drawn anew whenever the swarm's best has not risen.
enum class Topology { global, ring, von_neumann, random };

/// How much of its velocity a particle keeps: `inertia` throughout; from `inertia` to `last_inertia` in equal
/// steps; or 0.7298, with accelerations 1.4962, which make a swarm contract [Clerc, Kennedy 2002].
enum class Momentum { constant, decreasing, constriction };

/// Where particles start: at random where the space starts positions, at random all over the space (the
/// paper's), or on the golden-ratio lattice in freedom() dimensions [Roberts 2018], shifted by the seed.
enum class Placing { random, anywhere, lattice };

/// Defaults are the paper's, but for the placing. [Nest, s. 7.1, 8]
struct SwarmOptions {
  int particles = 200;   ///< of all swarms together, >= 1
  int iterations = 500;  ///< >= 0
  Momentum momentum = Momentum::constant;
  double inertia = 0.98, last_inertia = 0.4;  ///< [0, 1]
  double own = 0.01, social = 0.01;           ///< pull of a particle's own best, and of its neighbours'; >= 0
  Topology topology = Topology::global;
  Placing placing = Placing::lattice;
  double first_speed = 0.5;  ///< first velocities are this part of the way to another random position; >= 0
  int candidates = 1;        ///< positions that each particle tries before it starts from the best, >= 1
  int swarms = 1;            ///< that know nothing of each other, >= 1
  int patience = 0;          ///< iterations without a rise after which a swarm starts anew; 0: never
  double rise = 1e-4;        ///< the least relative rise that counts as one, >= 0
  std::uint64_t seed = 1;

  /// What is wrong with them, such as "inertia = 1.4; expected a number in [0, 1]".
  [[nodiscard]] std::optional<std::string> invalid() const;
};

/// @throws InputError  not one of the names
[[nodiscard]] Topology parse_topology(std::string_view text);
[[nodiscard]] Momentum parse_momentum(std::string_view text);
[[nodiscard]] Placing parse_placing(std::string_view text);
[[nodiscard]] std::string_view to_string(Topology topology);
[[nodiscard]] std::string_view to_string(Momentum momentum);
[[nodiscard]] std::string_view to_string(Placing placing);

/// All there is to know of a search: one that goes on from a copy ends as the other does.
struct SwarmState {
  int iteration = 0;
  std::vector<double> x, v;  ///< positions and velocities [particles * size]
  std::vector<double> own;   ///< every particle's best position
  std::vector<double> own_value;
  std::vector<int> rose;     ///< of every swarm, the iteration in which its best last rose,
  std::vector<int> drawn;    ///< the last one in which it did not,
  std::vector<int> placed;   ///< the positions its particles have tried to start from,
  std::vector<double> top;   ///< and its best since it was placed
  std::vector<double> best;  ///< the best position ever seen; empty before the first
  double best_value = -std::numeric_limits<double>::infinity();
  std::uint64_t evaluations = 0;
};

/// One iteration's outcome.
struct SwarmStep {
  int iteration;
  double best;      ///< ever
  double mean;      ///< of the particles' own bests, of those that have one
  double feasible;  ///< part of the positions asked for that were
  std::uint64_t evaluations;
};

/// v <- inertia v + own r (p - x) + social r' (g - x), x <- x + v, projected. [Nest, eq. 2-3]
///
/// A particle's value is asked for with its own best as the floor. Results depend on the seed and the
/// objective alone.
class Swarm {
 public:
  /// @param objective  kept
  /// @throws InputError  invalid options
  Swarm(Objective& objective, const SwarmOptions& options);

  [[nodiscard]] const SwarmOptions& options() const { return options_; }

  /// The particles placed and asked: their first candidates.
  /// @param step  where to say what that gave; may be nullptr
  [[nodiscard]] SwarmState start(SwarmStep* step = nullptr) const;
  /// One iteration further: further candidates, then motion.
  SwarmStep step(SwarmState& state) const;
  /// Another's position in place of the worst particle's own best and position, where it is better.
  void take_in(SwarmState& state, const std::vector<double>& x) const;

 private:
  struct Pull {
    double keep, own, social;
  };
  [[nodiscard]] Pull pull(int iteration) const;
  [[nodiscard]] int first_of(int swarm) const;
  [[nodiscard]] int neighbourhood_best(const SwarmState& state, int swarm, int particle) const;
  void place(SwarmState& state, int swarm) const;
  SwarmStep ask(SwarmState& state) const;
  [[nodiscard]] double number(std::uint64_t stream, int iteration, int particle, int k) const;

  Objective& objective_;
  SwarmOptions options_;
  int size_, freedom_;
};

}  // namespace kreisel::core::nest
