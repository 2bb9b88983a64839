#include "run/result.hpp"

#include <cmath>

namespace kreisel {

Moments RunResult::model_moments(const Moments& body) const {
  // Body units -> mm and grams, then x = R^T X L + origin.
  const Moments turned = transformed(scaled(body, frame.length, mass_unit_grams / std::pow(frame.length, 3)),
                                     frame.rotation.transpose(), frame.origin);
  return turned;
}

}  // namespace kreisel
