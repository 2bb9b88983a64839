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

Moments RunResult::model_moments(const Moments& body) const {
  // Body units -> mm and grams, then x = R^T X L + origin.
  const Moments turned = transformed(scaled(body, frame.length, mass_unit_grams / std::pow(frame.length, 3)),
                                     frame.rotation.transpose(), frame.origin);
  return turned;
}

}  // namespace kreisel::core
