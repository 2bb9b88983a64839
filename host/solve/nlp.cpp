#include "solve/nlp.hpp"

#include <algorithm>
#include <cmath>

#include "solve/central_path.hpp"
#include "solve/interrupt.hpp"

namespace kreisel {

Nlp::Nlp(const Task& task, std::vector<double> start)
    : task_(task),
      n_(task.formulation.num_variables()),
      start_(std::move(start)),
      own_(task.formulation.own_constraints()) {
  const LinearConstraints& c = task.problem.constraints();
  for (Eigen::Index r = 0; r < c.matrix.rows(); ++r) {
    if (!margin()) {
      rows_.push_back({r, 0, c.lower[r], c.upper[r]});
      continue;
    }
    if (std::isfinite(c.upper[r])) rows_.push_back({r, -1, -infinity, c.upper[r]});
    if (std::isfinite(c.lower[r])) rows_.push_back({r, 1, c.lower[r], infinity});
  }
}

void Nlp::problem_row_bounds(Number* lower, Number* upper) const {
  for (const Row& row : rows_) {
    *lower++ = std::max(row.lower, -infinity);
    *upper++ = std::min(row.upper, infinity);
  }
  std::fill_n(lower, equation_count(), 0.0);
  std::fill_n(upper, equation_count(), 0.0);
}

void Nlp::problem_rows(const Moments& s, const Number* at, Number* g) const {
  const double t = margin() ? *at : 0;
  for (const Row& row : rows_) *g++ = form(row).dot(s) + row.slope * t;
  if (!own_form()) return;
  const Eigen::VectorXd residuals = own_form()->residuals(s, last(at));
  std::ranges::copy(residuals, g);
}

void Nlp::last_bounds(Number* lower, Number* upper) const {
  std::fill_n(lower, last_count(), -infinity);
  std::fill_n(upper, last_count(), infinity);
}

void Nlp::last_start(const Moments& s, Number* at) const {
  if (margin()) *at = margin_at(s);
  if (own_form()) std::ranges::copy(own_form()->start(s), at);
}

double Nlp::margin_at(const Moments& s) const {
  double t = -infinity;
  for (const Row& row : rows_) {
    const double value = form(row).dot(s);
    t = std::max(t, row.slope < 0 ? value - row.upper : row.lower - value);
  }
  return t;
}

bool Nlp::intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number objective, Number inf_pr,
                                Number inf_du, Number mu, Number, Number regularization, Number, Number,
                                Index ls_trials, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  history_.push_back({iteration, objective, inf_pr, inf_du, mu, regularization, ls_trials});
  return !interrupted();
}

std::vector<double> Nlp::slopes(std::span<const double> x) const {
  std::vector<double> slope(n_);
  const Moments weight = lagrange_weight(x, warm_.multipliers);
  task_.formulation.pull_back(x, {&weight, 1}, slope);
  return slope;
}

void Nlp::go_on(const WarmStart& warm, double barrier) {
  warm_ = warm;
  const Bounds& bounds = task_.formulation.bounds();
  to_central_path(start_, slopes(start_), regulariser().empty() ? nullptr : task_.formulation.regulariser(),
                  bounds, barrier);
  for (std::size_t i = 0; i < n_; ++i) {
    z_lower_.push_back(barrier / (start_[i] - bounds.lower[i]));
    z_upper_.push_back(barrier / (bounds.upper[i] - start_[i]));
  }
}

void Nlp::start_variables(Number* x, bool with_z, Number* z_L, Number* z_U, bool with_lambda,
                          Number* lambda) const {
  std::ranges::copy(start_, x);
  if (with_z) {
    std::ranges::copy(z_lower_, z_L);
    std::ranges::copy(z_upper_, z_U);
  }
  if (with_lambda) std::ranges::copy(warm_.multipliers, lambda);
}

void Nlp::finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*,
                            Index m, const Number*, const Number* lambda, Number, const Ipopt::IpoptData*,
                            Ipopt::IpoptCalculatedQuantities*) {
  warm_.multipliers.assign(lambda, lambda + m);
  // Ipopt relaxes bounds by bound_relax_factor; the answer has to keep them.
  solution_.assign(x, x + n_);
  if (own_form()) auxiliary_.assign(x + n - last_count(), x + n);
  const Bounds& bounds = task_.formulation.bounds();
  for (std::size_t i = 0; i < n_; ++i)
    solution_[i] = std::clamp(solution_[i], bounds.lower[i], bounds.upper[i]);
}

void Nlp::fill_bounds(Number* lower, Number* upper) const {
  std::ranges::copy(task_.formulation.bounds().lower, lower);
  std::ranges::copy(task_.formulation.bounds().upper, upper);
}

Nlp::Index Nlp::own_structure(Index row, Index* i, Index* j) const {
  for (const SparseRows::Entry& entry : own_.entries) {
    *i++ = row + entry.row;
    *j++ = entry.column;
  }
  return static_cast<Index>(own_.entries.size());
}

Nlp::Index Nlp::own_values(Number* values) const {
  for (const SparseRows::Entry& entry : own_.entries) *values++ = entry.value;
  return static_cast<Index>(own_.entries.size());
}

std::span<const SparseRows::Entry> Nlp::regulariser() const {
  const SparseForm* form = task_.formulation.regulariser();
  if (!form || margin()) return {};
  return form->entries;
}

double Nlp::regulariser_value(const Number* x) const {
  return regulariser().empty() ? 0.0 : task_.formulation.regulariser()->value(variables(x));
}

void Nlp::add_regulariser_gradient(const Number* x, Number* gradient) const {
  if (!regulariser().empty()) task_.formulation.regulariser()->add_gradient(variables(x), {gradient, n_});
}

void Nlp::own_rows(const Number* x, Number* g) const {
  std::fill_n(g, own_.lower.size(), 0.0);
  for (const SparseRows::Entry& entry : own_.entries) g[entry.row] += entry.value * x[entry.column];
}

void Nlp::own_row_bounds(Number* lower, Number* upper) const {
  std::ranges::copy(own_.lower, lower);
  std::ranges::copy(own_.upper, upper);
}

}  // namespace kreisel
