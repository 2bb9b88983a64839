#include "session/result.hpp"

#include <cmath>
#include <limits>

namespace kreisel::core {

double RunResult::gap() const {
  const double f = outcome.objective, bound = certificate.value().bound;
  constexpr double met = 1e-6;  // solvers meet 1e-9; what misses its constraints may well lie below the bound
  if (!std::isfinite(bound) || !(outcome.violation <= met)) return std::numeric_limits<double>::infinity();
  return (f - bound) / std::abs(f);
}

Moments RunResult::model_moments(const Moments& body) const { return model_moments(body, frame); }

Moments RunResult::model_moments(const Moments& body, const Frame& about) const {
  // Body units -> mm and grams, then x = R^T X L + origin.
  return transformed(scaled(body, about.length, mass_unit_grams / std::pow(about.length, 3)),
                     about.rotation.transpose(), about.origin);
}

}  // namespace kreisel::core
