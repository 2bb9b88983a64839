#include "solve/second_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solve/dense.hpp"

namespace kreisel::core {
namespace {

using Matrix = Eigen::MatrixXd;
using Forms = Eigen::Matrix<double, Eigen::Dynamic, 10>;
using Answer = LocalMinimum::Answer;

LocalMinimum undecided(std::string why) {
  LocalMinimum result;
  result.why = std::move(why);
  return result;
}

/// The rows that count as equalities, and whether others hold that may or may not.
std::pair<Forms, bool> active_rows(const Rows& rows, const MomentPoint& point, double size,
                                   double tolerance) {
  std::vector<Eigen::Index> active;
  bool doubtful = false;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const double multiplier = i < point.multipliers.size() ? point.multipliers[i] : 0;
    if (rows.equality[static_cast<std::size_t>(i)] || multiplier > 1e-9 * size)
      active.push_back(i);
    else
      doubtful = doubtful || rows.matrix.row(i).dot(point.s) >= rows.bound[i] - 1e4 * tolerance;
  }
  return {rows.matrix(active, Eigen::all), doubtful};
}

}  // namespace

std::string_view to_string(LocalMinimum::Answer answer) {
  return answer == Answer::yes ? "yes" : answer == Answer::no ? "no" : "undecided";
}

std::string LocalMinimum::text() const {
  const std::string of =
      std::isnan(smallest)
          ? ""
          : fmt::format(", smallest eigenvalue {:.3g} on the tangent space of {} dimension{}", smallest,
                        dimension, dimension == 1 ? "" : "s");
  const std::string none = strict == Answer::yes && dimension == 0 ? ", the tangent space is {0}" : "";
  return fmt::format("{}{}{}{}", to_string(strict), of, none, why.empty() ? "" : ": " + why);
}

LocalMinimum second_order(const Matrix10& g, const Matrix10& b, const Forms& rows, double zero) {
  if (!g.allFinite() || !b.allFinite()) return undecided("the quadric touches whole rays");
  const SymmetricModes modes = symmetric_modes(g);
  const double largest = modes.values.cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> range;
  for (Eigen::Index i = 0; i < 10; ++i)
    if (modes.values[i] > 1e-3 * zero * largest) range.push_back(i);  // q itself is never among them
  // d = root y runs through the range of G, and d . G^+ d = |y|^2.
  const Matrix vectors = modes.vectors(Eigen::all, range);
  const Eigen::VectorXd roots = modes.values(range).cwiseSqrt();
  const Matrix root = vectors * roots.asDiagonal();
  // Rows that a symmetric body makes alike agree to round-off.
  const Matrix tangent = kernel_of(rows.rowwise().normalized() * root, 1e-10);
  LocalMinimum result;
  result.dimension = static_cast<int>(tangent.cols());
  if (result.dimension == 0) {
    result.strict = Answer::yes;
    return result;
  }
  const Matrix steps = root * tangent;
  const Matrix form = Matrix::Identity(tangent.cols(), tangent.cols()) + steps.transpose() * b * steps;
  const SymmetricModes eigen = symmetric_modes(form);
  result.smallest = eigen.values[0];
  const Eigen::VectorXd y = tangent * eigen.vectors.col(0);
  result.direction = -(vectors * y.cwiseQuotient(roots));  // s(q + p) = s - G p
  if (std::abs(result.smallest) <= zero * std::max(1.0, eigen.values.cwiseAbs().maxCoeff()))
    result.why = "the minimum is not isolated, as far as digits go";
  else
    result.strict = result.smallest > 0 ? Answer::yes : Answer::no;
  if (result.strict == Answer::no) result.why = "f falls nearby; start elsewhere, by moment.seed";
  return result;
}

LocalMinimum second_order(const Problem& problem, TotalSupport& oracle, const MomentPoint& point,
                          double tolerance) {
  if (problem.goal() == Goal::margin) return undecided("a margin is decided in the first order");
  const Rows rows = rows_of(problem.constraints(), false);
  const Moments gradient = problem.gradient(point.s);
  const double size = gradient.cwiseAbs().maxCoeff();
  Moments q = gradient;
  if (point.multipliers.size()) q += rows.matrix.transpose() * point.multipliers;
  if (!(q.cwiseAbs().maxCoeff() > 1e-9 * size)) return undecided("the quadric is 0");
  // Of a plane along the rays a term of z^2 says how to cut (dual.cpp), at no cost worth the name.
  if ((q - point.q).cwiseAbs().maxCoeff() > 1e-7 * q.cwiseAbs().maxCoeff())
    return undecided("a plane along the rays leaves whole rays open");
  const Matrix10 g = -(point.curvature ? *point.curvature : oracle(point.q, true).hessian);
  const auto [active, doubtful] = active_rows(rows, point, size, tolerance);
  LocalMinimum result = second_order(g, problem.hessian(point.s), active, std::max(1e-9, 1e4 * tolerance));
  // Without those rows f may fall where they forbid to go.
  if (doubtful && result.strict == Answer::no) {
    result.strict = Answer::undecided;
    result.why = "a constraint holds without a multiplier";
  }
  return result;
}

}  // namespace kreisel::core
