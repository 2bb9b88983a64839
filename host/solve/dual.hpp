// dual.hpp - least value of a convex quadratic over the attainable moments, through its concave dual.
#pragma once

#include <Eigen/Dense>
#include <stop_token>
#include <utility>
#include <vector>

#include "formulation/support_oracle.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// The oracle for total moments, shell included, that counts its passes.
class TotalSupport {
 public:
  /// @param level  see SupportOracle
  /// @param stop   ends the searches that go by this oracle
  TotalSupport(SupportOracle& oracle, const MassModel& mass, int level, std::stop_token stop = {})
      : oracle_(&oracle), mass_(&mass), level_(level), stop_(std::move(stop)) {}

  [[nodiscard]] Support operator()(const Moments& q, bool with_hessian);
  [[nodiscard]] bool stopped() const { return stop_.stop_requested(); }
  [[nodiscard]] int passes() const { return passes_; }
  [[nodiscard]] int hessian_passes() const { return hessian_passes_; }

 private:
  SupportOracle* oracle_;
  const MassModel* mass_;
  int level_, passes_ = 0, hessian_passes_ = 0;
  std::stop_token stop_;
};

/// Linear constraints c . s = b or c . s <= b, one a row.
struct Rows {
  Eigen::Matrix<double, Eigen::Dynamic, 10> matrix;
  Eigen::VectorXd bound;
  std::vector<bool> equality;

  [[nodiscard]] Eigen::Index size() const { return bound.size(); }
  /// The worst |c . s - b| of an equality or c . s - b of an inequality; 0 when all hold.
  [[nodiscard]] double violation(const Moments& s) const;
};

/// The constraints of a problem. @param split  equalities as two inequalities each, for the margin
[[nodiscard]] Rows rows_of(const LinearConstraints& constraints, bool split);

/// Minimise g . s + |factor^T s - target|^2 / 2 over attainable moments s that meet the rows; or with
/// `margin`, where no row is an equality, g . s + the least t with c . s <= b + t for all of them.
struct QuadraticModel {
  Moments linear = Moments::Zero();
  Eigen::Matrix<double, 10, Eigen::Dynamic> factor = Eigen::Matrix<double, 10, 0>();
  Eigen::VectorXd target = Eigen::VectorXd(0);
  bool margin = false;
};

struct DualPoint {
  enum Ending { converged, stalled, infeasible, interrupted } ending = stalled;
  Moments q = Moments::Zero();  ///< the quadric: linear + factor p + rows^T multipliers
  Moments s = Moments::Zero();  ///< s(q): the minimiser as far as converged
  Eigen::VectorXd multipliers;  ///< one a row; >= 0 for inequalities
  double slack = 0;             ///< t of a margin
  double residual = 0;          ///< largest violation of the optimality conditions
  std::vector<bool> active;     ///< rows that hold as equalities there
};

/// Newton's method on the dual, in few rows at a time: more join as they are violated. `infeasible`: the
/// separating quadric rows^T multipliers proves that no filling meets the rows.
///
/// @param start      multipliers to start from; empty: zero
/// @param tolerance  on the residual, body units
[[nodiscard]] DualPoint minimise_model(TotalSupport& oracle, const QuadraticModel& model, const Rows& rows,
                                       const Eigen::VectorXd& start, double tolerance);

}  // namespace kreisel::core
