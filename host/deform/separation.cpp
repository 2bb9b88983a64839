#include "deform/separation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "deform/submerged.hpp"
#include "solve/solver.hpp"
#include "solve/with_rows.hpp"

namespace kreisel::core {
namespace {

constexpr double met = 1e-6;  ///< what misses by less misses by round-off

LinearConstraints joined(LinearConstraints all, const LinearConstraints& more) {
  const Eigen::Index n = all.matrix.rows(), m = more.matrix.rows();
  if (m == 0) return all;
  all.matrix.conservativeResize(n + m, Eigen::NoChange);
  all.lower.conservativeResize(n + m);
  all.upper.conservativeResize(n + m);
  all.matrix.bottomRows(m) = more.matrix;
  all.lower.tail(m) = more.lower;
  all.upper.tail(m) = more.upper;
  all.names.insert(all.names.end(), more.names.begin(), more.names.end());
  return all;
}

Eigen::VectorXd multipliers_of(const Outcome& outcome, Eigen::Index rows) {
  if (static_cast<Eigen::Index>(outcome.multipliers.size()) != rows) return Eigen::VectorXd::Zero(rows);
  return Eigen::Map<const Eigen::VectorXd>(outcome.multipliers.data(), rows);
}

}  // namespace

Separation::Separation(const Body& body, const Problem& problem, double margin, std::stop_token stop)
    : problem_(&problem),
      margin_(margin),
      stop_(std::move(stop)),
      water_(problem.water()),
      also_near_(body.solid) {
  if (water_) submerged_before_ = submerged(body.local, water_->surface);
}

/// The problem's constraints, with the bounds that the water around this shape gives them.
LinearConstraints Separation::asked_of(const Shape& shape) const {
  LinearConstraints asked = problem_->constraints();
  if (!water_) return asked;
  const Moments more = water_->density * (submerged(shape.mesh(), water_->surface) - submerged_before_);
  asked.lower += asked.matrix * more;
  asked.upper += asked.matrix * more;
  return asked;
}

/// Of h(q), less what the water has of q.
Eigen::MatrixX3d Separation::slope_of(const Moments& q, const Shape& shape,
                                      const HandleMotion& motion) const {
  std::vector<Vec3> gradient = shape.gradient_of_least(q);
  if (water_) {
    const std::vector<Vec3> wet = submerged_gradient(shape.mesh(), water_->surface, q);
    for (std::size_t i = 0; i < wet.size(); ++i) gradient[i] -= water_->density * wet[i];
  }
  return motion.pulled_back(gradient);
}

Separated Separation::look(const Shape& shape, const HandleMotion& motion, const Eigen::MatrixX3d& u,
                           bool also) {
  LinearConstraints asked = asked_of(shape);
  if (also) asked = joined(std::move(asked), problem_->also_asked(also_near_));
  const Rows rows = rows_of(asked, true);
  const WithRows relaxed(*problem_, std::move(asked), Goal::margin);
  const SolverEntry& moment = find_solver("moment", "quadric");
  SolverOptions enough;  // far below what is taken for met, at half of the passes of all digits
  enough.own = moment.read({{"tolerance", "1e-9"}});
  const Outcome outcome = solve(moment, shape.task(relaxed, stop_), enough);

  Separated result;
  // With equalities the worst row cannot be better than met; else it is to be met with the margin.
  const LinearConstraints& c = relaxed.constraints();
  const double spare = (c.lower.array() == c.upper.array()).any() ? 0 : margin_;
  result.missed = std::max(0.0, (rows.matrix * outcome.moments - rows.bound).maxCoeff() + spare);
  for (Eigen::VectorXd& cut : cuts_) cut.conservativeResizeLike(Eigen::VectorXd::Zero(rows.size()));
  if (result.missed > met) {
    // Where all is met, any of many interiors may be the one: nothing to go by.
    also_near_ = outcome.moments;
    const Eigen::VectorXd multipliers = multipliers_of(outcome, rows.size());
    if (multipliers.sum() > 0) cuts_.push_back(multipliers / multipliers.sum());
  } else {
    result.missed = 0;
  }
  result.worst = -std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& cut : cuts_) {
    const Moments q = rows.matrix.transpose() * cut;
    const double value = shape.least(q) - rows.bound.dot(cut);
    const Eigen::MatrixX3d slope = slope_of(q, shape, motion);
    result.worst = std::max(result.worst, value);
    result.rows.add(slope, -margin_ - value + slope.cwiseProduct(u).sum());
  }
  return result;
}

std::optional<Separation::Value> Separation::value(const Shape& shape, const HandleMotion& motion) const {
  const SolverEntry& moment = find_solver("moment", "quadric");
  SolverOptions enough;
  enough.own = moment.read({{"tolerance", "1e-9"}});
  const WithRows here(*problem_, asked_of(shape), Goal::value);
  const Outcome outcome = solve(moment, shape.task(here, stop_), enough);
  if (!outcome.converged()) return std::nullopt;
  // df* = dh(q) with q the gradient of the Lagrangian: at the optimum the interior that q cuts is the best.
  const Rows rows = rows_of(here.constraints(), false);
  const Moments q =
      problem_->gradient(outcome.moments) + rows.matrix.transpose() * multipliers_of(outcome, rows.size());
  return Value{outcome.objective, slope_of(q, shape, motion)};
}

}  // namespace kreisel::core
