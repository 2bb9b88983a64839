// objective.hpp - what a swarm, or any other search, maximises.
#pragma once

#include <span>
#include <vector>

#include "nest/search/space.hpp"

namespace kreisel::core::nest {

/// A function of positions, asked for many at once.
class Objective {
 public:
  virtual ~Objective() = default;

  [[nodiscard]] virtual const Space& space() const = 0;

  /// Values at positions [count * space().size()], one after the other; minus infinity where infeasible.
  ///
  /// @param floors  one a position: a value that is not above its floor need not be exact, only not above it
  ///                either, so that its computation can be given up early
  [[nodiscard]] virtual std::vector<double> values(std::span<const double> positions,
                                                   std::span<const double> floors) = 0;

  /// The nearest position that may be asked for: the space's own, and whatever ties its parts together.
  virtual void project(std::span<double> x) const { space().project(x); }

  /// A starting position from space().freedom() numbers in [0, 1).
  virtual void place(std::span<const double> unit, std::span<double> x) const { space().place(unit, x); }
};

}  // namespace kreisel::core::nest
