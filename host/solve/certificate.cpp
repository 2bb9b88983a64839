#include "solve/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "control.hpp"
#include "formulation/quadric.hpp"
#include "solve/certify_spin.hpp"
#include "solve/moment.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

/// Multipliers that keep their promise of a sign.
Eigen::VectorXd signed_right(Eigen::VectorXd multipliers, const Rows& rows) {
  for (Eigen::Index i = 0; i < rows.size(); ++i)
    if (!rows.equality[static_cast<std::size_t>(i)]) multipliers[i] = std::max(multipliers[i], 0.0);
  return multipliers;
}

/// h(q) - bounds . multipliers, as far as it is certain, with as much again for a check by other arithmetic.
double certain(const SafeSupport& support, const Moments& q, const Rows& rows, const Eigen::VectorXd& mu) {
  const SafeSupport::Value value = support.at(q);
  const double offset = rows.bound.dot(mu);
  return value.h - 2 * value.margin - offset - 64 * 0x1p-53 * (rows.bound.cwiseAbs().dot(mu.cwiseAbs()));
}

void prove_infeasible(Certificate& c, const SafeSupport& support, const Eigen::VectorXd& multipliers) {
  const double scale = multipliers.lpNorm<Eigen::Infinity>();
  if (!(scale > 0)) return;
  c.multipliers = signed_right(multipliers / scale, c.rows);
  c.q = c.rows.matrix.transpose() * c.multipliers;
  c.separation = certain(support, c.q, c.rows, c.multipliers);
  if (!(c.separation > 0)) return;
  c.kind = Certificate::Kind::infeasible;
  c.bound = std::numeric_limits<double>::infinity();
}

void prove_linear(Certificate& c, const SafeSupport& support, const Outcome& outcome) {
  c.multipliers =
      signed_right(Eigen::Map<const Eigen::VectorXd>(outcome.multipliers.data(), c.rows.size()), c.rows);
  c.q = c.objective + c.rows.matrix.transpose() * c.multipliers;
  c.bound = certain(support, c.q, c.rows, c.multipliers);
}

void prove_ratio(Certificate& c, const SafeSupport& support, const Outcome& outcome, bool constrained) {
  const Eigen::Map<const Eigen::VectorXd> found(outcome.multipliers.data(),
                                                static_cast<Eigen::Index>(outcome.multipliers.size()));
  if (constrained) {
    // The gradient is (numerator - f denominator) / denominator . s.
    c.weights.setOnes(1);
    c.multipliers = signed_right(found * c.denominator.dot(outcome.moments), c.rows);
  } else {
    c.weights = found.cwiseMax(0.0);
    c.weights /= std::max(c.weights.sum(), 1e-300);
    c.multipliers.setZero(0);
  }
  const Moments above = c.numerators.transpose() * c.weights + c.rows.matrix.transpose() * c.multipliers;
  const auto bound = support.largest_ratio(above, c.denominator, outcome.objective);
  if (!bound) return;
  c.bound = *bound;
  c.q = above - *bound * c.denominator;
}

}  // namespace

std::string_view to_string(Certificate::Kind kind) {
  switch (kind) {
    case Certificate::Kind::linear:
      return "linear";
    case Certificate::Kind::ratio:
      return "ratio";
    case Certificate::Kind::spin:
      return "spin";
    case Certificate::Kind::yoyo:
      return "yoyo";
    case Certificate::Kind::top:
      return "top";
    case Certificate::Kind::infeasible:
      break;
  }
  return "infeasible";
}

Certificate certify(const Problem& problem, const Rays& domain, const MassModel& mass, device::Device& device,
                    const CertifyOptions& options) {
  const Stopwatch watch;
  const std::unique_ptr<Formulation> quadric = make_quadric(domain, device);
  const SafeSupport support(domain, mass);
  const Task task{problem, *quadric, mass, device, options.stop};
  const Outcome outcome = solve(find_solver("moment", "quadric"), task, {});
  if (options.stop.stop_requested()) throw Interrupted();

  Certificate c;
  c.bound = -std::numeric_limits<double>::infinity();
  c.contrast = mass.contrast;
  const std::optional<Ratio> ratio = problem.ratio();
  const bool constrained = !ratio || ratio->constrained;
  c.rows = rows_of(problem.constraints(), false);
  // What maximises a margin attains its value, whether that is enough or not.
  const bool infeasible = outcome.termination == Termination::infeasible;
  c.best = infeasible && problem.goal() == Goal::value ? std::numeric_limits<double>::infinity()
                                                       : outcome.objective;
  c.best_x = outcome.x;
  if (ratio) {
    c.kind = Certificate::Kind::ratio;
    c.numerators = ratio->numerators;
    c.denominator = ratio->denominator;
    if (!constrained) c.rows = {decltype(Rows::matrix)(0, 10), Eigen::VectorXd(0), {}};
  } else if (problem.convexity() == Convexity::linear) {
    c.objective = problem.gradient(outcome.moments);
  }

  if (infeasible && problem.goal() == Goal::value)
    prove_infeasible(c, support,
                     Eigen::Map<const Eigen::VectorXd>(
                         outcome.multipliers.data(), static_cast<Eigen::Index>(outcome.multipliers.size())));
  if (c.kind == Certificate::Kind::infeasible) {
    c.reached = true;
    c.message = "no interior meets the constraints";
  } else if (const auto* spin = dynamic_cast<const Spinning*>(&problem)) {
    c.spin = spin->weights();
    if (spin->centred()) {
      c.kind = Certificate::Kind::yoyo;
      certify_centred(c, *spin, task, support, outcome);
    } else {
      c.kind = c.spin.moment > 0 ? Certificate::Kind::top : Certificate::Kind::spin;
      certify_spin(c, *spin, task, support, outcome, options, [&] { return watch.seconds(); });
    }
  } else if (ratio) {
    prove_ratio(c, support, outcome, constrained);
  } else if (problem.convexity() == Convexity::linear) {
    prove_linear(c, support, outcome);
  } else {
    c.message = fmt::format("no certificate is known for {}", problem.name());
  }
  if (c.kind != Certificate::Kind::infeasible)
    c.reached = std::isfinite(c.best) && c.best - c.bound <= options.gap * std::abs(c.best);
  if (infeasible && problem.goal() == Goal::margin && c.bound > 0)
    c.message = "that is above 0 for every interior, so none does what was asked";
  if (c.message.empty()) c.message = c.reached ? "the gap was reached" : "the multipliers prove no more";
  c.seconds = watch.seconds();
  return c;
}

}  // namespace kreisel::core
