// nlp.hpp - what the two Ipopt forms of a task have in common.
#pragma once

#include <IpTNLP.hpp>
#include <span>
#include <vector>

#include "solve/solver.hpp"

namespace kreisel::core {

/// Bookkeeping of a solve: start point, iterates, final x, and the problem's constraints as rows. The forms
/// add functions and derivatives.
///
/// When the goal is the margin there is one variable more, t, the last; it is the objective, and each bound
/// of a constraint is a row of its own: C s - t <= u and C s + t >= l. A problem's own variables (Nonlinear)
/// are the last as well, and its rows are behind those of the constraints.
class Nlp : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  Nlp(const Task& task, std::vector<double> start);

  /// Starts from the multipliers of a solve before, which are those of the same rows: on their central path.
  /// Cells that they hold at a bound, and would even if the void's surface moved by a quarter of a cell, are
  /// taken out of the problem: released() says where that was wrong.
  ///
  /// @param held  from a solve before, less released(); empty: to be found
  /// @return      the barrier parameter to start with, of the objective as it is
  double go_on(const WarmStart& warm, std::vector<std::uint8_t> held);

  [[nodiscard]] const std::vector<std::uint8_t>& held() const { return held_; }
  /// Which of the held variables the multipliers at the solution would let go; empty: none.
  [[nodiscard]] std::vector<std::uint8_t> released() const;

  /// Whether all its rows are linear in the variables.
  [[nodiscard]] bool jacobian_is_constant() const {
    return task_.formulation.moments_are_linear() && !own_form();
  }
  [[nodiscard]] const WarmStart& warm() const { return warm_; }
  [[nodiscard]] const std::vector<double>& solution() const { return solution_; }
  [[nodiscard]] const std::vector<double>& auxiliary() const { return auxiliary_; }
  [[nodiscard]] const Evaluations& evaluations() const { return evaluations_; }
  [[nodiscard]] const std::vector<Iterate>& history() const { return history_; }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective, Number inf_pr,
                             Number inf_du, Number mu, Number d_norm, Number regularization, Number alpha_du,
                             Number alpha_pr, Index ls_trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override;
  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* x, const Number* z_L,
                         const Number* z_U, Index m, const Number* g, const Number* lambda, Number objective,
                         const Ipopt::IpoptData* data, Ipopt::IpoptCalculatedQuantities* quantities) override;

 protected:
  /// One row of the problem: lower <= C_r s + slope t <= upper.
  struct Row {
    Eigen::Index constraint;
    double slope, lower, upper;  ///< slope is 0 unless the goal is the margin
  };
  static constexpr double infinity = 2e19;  // Ipopt's nlp_upper_bound_inf is 1e19

  [[nodiscard]] bool margin() const { return task_.problem.goal() == Goal::margin; }
  /// The problem's nonlinear rows and own variables, where it has any.
  [[nodiscard]] const Nonlinear* own_form() const { return margin() ? nullptr : task_.problem.nonlinear(); }
  /// How many variables come last: the margin, or the problem's own.
  [[nodiscard]] std::size_t last_count() const {
    return margin() ? 1 : own_form() ? own_form()->variables() : 0;
  }
  [[nodiscard]] std::size_t nonlinear_count() const {
    return own_form() ? static_cast<std::size_t>(own_form()->lower().size()) : 0;
  }
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> last(const Number* at) const {
    return {at, static_cast<Eigen::Index>(last_count())};
  }
  void last_bounds(Number* lower, Number* upper) const;
  /// Where they start, given the moments of the start.
  void last_start(const Moments& s, Number* at) const;
  [[nodiscard]] auto form(const Row& row) const {
    return task_.problem.constraints().matrix.row(row.constraint);
  }
  /// Rows of the problem: its constraints and then the nonlinear ones.
  [[nodiscard]] std::size_t problem_row_count() const { return rows_.size() + nonlinear_count(); }
  void problem_row_bounds(Number* lower, Number* upper) const;
  /// @param at  where the last variables are
  void problem_rows(const Moments& s, const Number* at, Number* g) const;
  /// The smallest t that the start allows.
  [[nodiscard]] double margin_at(const Moments& s) const;
  /// The weights of the moments in the gradient of the Lagrangian by x.
  [[nodiscard]] virtual Moments lagrange_weight(std::span<const double> x,
                                                std::span<const double> multipliers) const = 0;
  /// The moments' part of that gradient.
  [[nodiscard]] std::vector<double> slopes(std::span<const double> x) const;
  /// How far from each variable's cell the void's surface is, in cells; its sign is that of the slope.
  [[nodiscard]] std::vector<double> distances(std::span<const double> slope) const;
  void hold(std::span<const double> slope);
  /// Where a solve starts: x, and when it goes on from another, all multipliers.
  void start_variables(Number* x, bool with_z, Number* z_L, Number* z_U, bool with_lambda,
                       Number* lambda) const;
  [[nodiscard]] std::span<const double> variables(const Number* x) const { return {x, n_}; }
  void fill_bounds(Number* lower, Number* upper) const;
  /// Of the formulation's regulariser, which a margin has none of: it is a distance, not an objective.
  [[nodiscard]] std::span<const SparseRows::Entry> regulariser() const;
  [[nodiscard]] double regulariser_value(const Number* x) const;
  void add_regulariser_gradient(const Number* x, Number* gradient) const;
  /// Structure and values of the formulation's own rows, the first of which is `row`; returns how many were
  /// written.
  Index own_structure(Index row, Index* i, Index* j) const;
  Index own_values(Number* values) const;
  void own_rows(const Number* x, Number* g) const;
  void own_row_bounds(Number* lower, Number* upper) const;

  Task task_;
  std::size_t n_;
  std::vector<double> start_;
  std::vector<Row> rows_;
  SparseRows own_;
  Evaluations evaluations_;

 private:
  std::vector<double> solution_, auxiliary_;
  WarmStart warm_;
  Bounds bounds_;
  std::vector<std::uint8_t> held_;         ///< variables whose bounds are one
  std::vector<double> z_lower_, z_upper_;  ///< of the bounds, to go on from
  std::vector<Iterate> history_;
};

/// min f(s(x)) s.t. the problem's and the formulation's constraints; gradients only.
Ipopt::SmartPtr<Nlp> make_direct_nlp(const Task& task, std::vector<double> start);

/// min f(s) over (x, s) s.t. s = s(x) and the same constraints; exact Hessian.
///
/// @param convexify  raise the negative entries of the diagonal of d2/dx2 to zero. A ray's end is then, at
/// worst,
///                   linear, like a voxel's fill, and the barrier alone curves it: no inertia to correct. At
///                   a minimum the entries of free variables are positive, so the end stays quadratic.
Ipopt::SmartPtr<Nlp> make_lifted_nlp(const Task& task, std::vector<double> start, bool convexify);

}  // namespace kreisel::core
