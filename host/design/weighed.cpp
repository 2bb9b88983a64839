#include "design/weighed.hpp"

#include <fmt/format.h>

#include <limits>

#include "error.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

Weighed weighed_as(double measured, double expected, double density) {
  constexpr double most = 3;  // lead for plastic is no error of a density
  if (!(measured < most * expected) || !(expected < most * measured))
    throw InputError(fmt::format(
        "--measured-mass {:.4g} of a part that weighs {:.4g} g at {:.4g} g/cm^3, expected what scales say of "
        "the part that the same command made without it",
        measured, expected, density));
  return {measured, expected, density * measured / expected};
}

void require_one_density(const BodySpec& body) {
  if (!body.interior_density && !(body.void_density > 0)) return;
  throw InputError("--measured-mass of a part of several materials, expected one: scales tell no two apart");
}

std::optional<SurvivedErrors> survived_errors(const SolvedRun& run, const Moments& part) {
  const double length = run.result.length_mm;
  // What is not printed, an axle of the shop, keeps its mass.
  const Moments added = run.body().added, printed = part - added;
  const auto does = [&](double scale) { return run.problem().verify(added + scale * printed, length).ok; };
  if (!does(1)) return std::nullopt;
  const auto last = [&](double far) {
    if (does(far)) return std::numeric_limits<double>::infinity();
    double good = 1, bad = far;
    for (int step = 0; step < 30; ++step) {
      const double middle = (good + bad) / 2;
      (does(middle) ? good : bad) = middle;
    }
    return 100 * (good - 1);
  };
  return SurvivedErrors{last(0.5), last(1.5)};
}

}  // namespace kreisel::core
