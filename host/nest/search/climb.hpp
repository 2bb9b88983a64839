// climb.hpp - local refinement of a position: an evolution strategy that learns which steps go together.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "nest/search/objective.hpp"

namespace kreisel::core::nest {

struct ClimbOptions {
  int offspring = 32;                          ///< asked at once, >= 1
  int iterations = 300;                        ///< at most, >= 0
  double first_step = 0.05, last_step = 1e-5;  ///< standard deviations, units of Space::move; it ends below
                                               ///< the last; both > 0
  std::uint64_t seed = 1;

  [[nodiscard]] std::optional<std::string> invalid() const;
};

/// All there is to know of a climb.
struct ClimbState {
  int iteration = 0;
  std::vector<double> x;
  double value = -std::numeric_limits<double>::infinity();
  double step = 0;                       ///< standard deviation
  double success = 0;                    ///< smoothed rate of offspring that are better
  std::vector<double> covariance, path;  ///< [steps * steps], [steps]
  std::uint64_t evaluations = 0;
};

/// (1 + lambda) evolution strategy with covariance matrix adaptation [Igel, Hansen, Roth 2007, Covariance
/// matrix adaptation for multi-objective optimization, s. 2; there with one offspring or more]. Only
/// offspring that are better than their parent count, so its value is every one's floor, and a search that
/// can give up early does so nearly always. Steps are turns and shares of ranges, never components of
/// quaternions.
class Climb {
 public:
  /// @throws InputError  invalid options
  Climb(Objective& objective, const ClimbOptions& options);

  [[nodiscard]] ClimbState start(std::vector<double> x, double value) const;
  /// One generation. @return  whether there is more to be hoped for
  bool step(ClimbState& state) const;

 private:
  Objective& objective_;
  ClimbOptions options_;
};

}  // namespace kreisel::core::nest
