#include "design/figures.hpp"

#include <utility>

#include "problem/problem.hpp"

namespace kreisel::core {

Figures figures_of(const Moments& body, double volume, const RunResult& run, Verdict verdict) {
  // About the body's own origin, along the model's axes: far from the model's origin digits would cancel.
  Frame frame = run.frame;
  frame.origin = Vec3::Zero();
  const Moments s = run.model_moments(body, frame);
  Figures f;
  f.mass = s[S1];
  f.volume = volume;
  f.centre_of_mass = run.frame.origin + kreisel::core::centre_of_mass(s);
  f.inertia = inertia_about_centre(s);
  const PrincipalAxes principal(f.inertia);
  f.principal = principal.moments;
  f.axes = principal.axes;
  if (f.axes.determinant() < 0) f.axes.col(0) *= -1;
  f.verdict = std::move(verdict);
  return f;
}

Residual residual_of(const Figures& figures, const RunConfig& config) {
  const ProblemEntry& problem = find_problem(config.problem);
  if (!problem.misses) return {Misses::none, Misses::none, Misses::none};
  const Misses misses = problem.misses(figures.verdict.values, problem_settings(config));
  const double excess = misses.excess_mass;
  return {misses.centre_of_mass_mm, misses.axis_degrees, figures.mass * excess / (1 + excess)};
}

}  // namespace kreisel::core
