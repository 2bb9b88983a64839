// weighed.hpp - a first print on the scales, and the errors that a part survives.
#pragma once

#include <optional>

#include "session/solved_run.hpp"

namespace kreisel::core {

/// What the scales say of the density.
struct Weighed {
  double measured = 0, expected = 0;  ///< g
  double density = 0;                 ///< g/cm^3, as it follows
};

/// @throws InputError  so far off that it is hardly that part
[[nodiscard]] Weighed weighed_as(double measured, double expected, double density);

/// @throws InputError  several materials, of which the scales say nothing
void require_one_density(const BodySpec& body);

/// By how many per cent what is printed may weigh less and more, everywhere alike, as errors of flow or
/// density make it, and still do what was asked. Infinite: more than a half.
struct SurvivedErrors {
  double least = 0, most = 0;
};

/// @param part  moments, body frame and units  @return  nothing where it does not do it as it is
[[nodiscard]] std::optional<SurvivedErrors> survived_errors(const SolvedRun& run, const Moments& part);

}  // namespace kreisel::core
