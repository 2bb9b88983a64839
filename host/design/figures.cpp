#include "design/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kreisel::core {

Figures figures_of(const Moments& body, double volume, const RunResult& run, const Problem& problem) {
  const Moments s = run.model_moments(body);
  Figures f;
  f.mass = s[S1];
  f.volume = volume;
  f.centre_of_mass = kreisel::core::centre_of_mass(s);
  f.inertia = inertia_about_centre(s);
  const PrincipalAxes principal(f.inertia);
  f.principal = principal.moments;
  f.axes = principal.axes;
  if (f.axes.determinant() < 0) f.axes.col(0) *= -1;
  f.verdict = problem.verify(body, run.length_mm);
  return f;
}

Residual residual_of(const Figures& figures, const RunConfig& config) {
  const auto value = [&](const char* name) {
    const auto entry = figures.verdict.values.find(name);
    return entry == figures.verdict.values.end() ? std::numeric_limits<double>::quiet_NaN() : entry->second;
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (config.problem == "stand") {
    const auto target = config.settings.find("problem.target");
    const bool over_centre = target == config.settings.end() || target->second == "centre";
    return {over_centre ? value("off_centroid_mm") : std::max(0.0, -value("inside_mm")), none, none};
  }
  if (std::isfinite(value("offset_mm"))) {
    const double excess = value("excess_mass");  // share of the displaced mass, where there is one
    return {value("offset_mm"), none, figures.mass * excess / (1 + excess)};
  }
  double off = value("off_axis_mm");
  if (config.problem == "yoyo") off = std::hypot(off, value("centre_of_mass_z_mm"));
  return {off, value("tilt_degrees"), none};
}

}  // namespace kreisel::core
