#include "solve/nlp.hpp"

#include <algorithm>
#include <cmath>

#include "solve/central_path.hpp"

namespace kreisel::core {

Nlp::Nlp(const Task& task, std::vector<double> start)
    : task_(task),
      n_(task.formulation.num_variables()),
      start_(std::move(start)),
      own_(task.formulation.own_constraints()),
      bounds_(task.formulation.bounds()) {
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
  if (!own_form()) return;
  for (const double bound : own_form()->lower()) *lower++ = std::max(bound, -infinity);
  for (const double bound : own_form()->upper()) *upper++ = std::min(bound, infinity);
}

void Nlp::problem_rows(const Moments& s, const Number* at, Number* g) const {
  const double t = margin() ? *at : 0;
  for (const Row& row : rows_) *g++ = form(row).dot(s) + row.slope * t;
  if (!own_form()) return;
  std::ranges::copy(own_form()->rows(s, last(at)), g);
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
  return !task_.stop.stop_requested();
}

std::vector<double> Nlp::slopes(std::span<const double> x) const {
  std::vector<double> slope(n_);
  const Moments weight = lagrange_weight(x, warm_.multipliers);
  task_.pull_back(x, {&weight, 1}, slope);
  return slope;
}

std::vector<double> Nlp::distances(std::span<const double> slope) const {
  // By volume the slope is a field that is zero on the void's surface, and changes by `step` from a cell to
  // the next of its size.
  std::vector<double> volume(n_), field(n_), step(n_, 0.0), any(n_, 0.0);
  const Moments unit = Moments::Unit(S1);
  task_.formulation.pull_back(start_, {&unit, 1}, volume);
  for (std::size_t i = 0; i < n_; ++i) field[i] = slope[i] / volume[i];
  for (const SparseRows::Entry& e : regulariser()) {
    const auto i = static_cast<std::size_t>(e.row), j = static_cast<std::size_t>(e.column);
    const bool alike = volume[i] <= 2 * volume[j] && volume[j] <= 2 * volume[i];
    const double change = std::abs(field[i] - field[j]);
    for (const std::size_t k : {i, j}) (alike ? step : any)[k] = std::max((alike ? step : any)[k], change);
  }
  for (std::size_t i = 0; i < n_; ++i) {
    if (step[i] == 0) step[i] = any[i];
    field[i] = step[i] > 0 ? field[i] / step[i] : 0;
  }
  return field;
}

void Nlp::hold(std::span<const double> slope) {
  constexpr double moves =
      0.25;  // cells, the void's surface from one round to the next (measured: below 0.1)
  constexpr double at_bound = 1e-2;
  const std::vector<double> distance = distances(slope);
  for (std::size_t i = 0; i < n_; ++i) {
    const double share = (start_[i] - bounds_.lower[i]) / (bounds_.upper[i] - bounds_.lower[i]);
    held_[i] = (share < at_bound || share > 1 - at_bound) && std::abs(distance[i]) > moves;
  }
}

double Nlp::go_on(const WarmStart& warm, std::vector<std::uint8_t> held) {
  warm_ = warm;
  held_ = std::move(held);
  const std::vector<double> slope = slopes(start_);
  std::vector<double> sizes(n_);
  std::ranges::transform(slope, sizes.begin(), [](double s) { return std::abs(s); });
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(n_ / 2);
  std::ranges::nth_element(sizes, middle);
  // A cell of the median slope is then half way from its bound to the middle.
  const double barrier = *middle;
  const SparseForm* form = regulariser().empty() ? nullptr : task_.formulation.regulariser();
  if (held_.empty()) {
    held_.assign(n_, 0);
    constexpr double narrow = 1e-3;  // where cells at a bound are seen to be there
    to_central_path(start_, slope, form, bounds_, narrow * barrier);
    if (form) hold(slope);
  }
  for (std::size_t i = 0; i < n_; ++i)
    if (held_[i])
      start_[i] = bounds_.lower[i] = bounds_.upper[i] =
          start_[i] > (bounds_.lower[i] + bounds_.upper[i]) / 2 ? bounds_.upper[i] : bounds_.lower[i];
  to_central_path(start_, slope, form, bounds_, barrier);
  z_lower_.assign(n_, 0.0);
  z_upper_.assign(n_, 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    if (held_[i]) continue;
    z_lower_[i] = barrier / (start_[i] - bounds_.lower[i]);
    z_upper_[i] = barrier / (bounds_.upper[i] - start_[i]);
  }
  return barrier;
}

std::vector<std::uint8_t> Nlp::released() const {
  std::vector<std::uint8_t> released;
  if (std::ranges::find(held_, 1) == held_.end() || solution_.empty()) return released;
  std::vector<double> slope = slopes(solution_);
  if (!regulariser().empty()) task_.formulation.regulariser()->add_gradient(solution_, slope);
  const std::vector<double> distance = distances(slope);
  constexpr double far = 0.01;  // cells; nearer, a variable would leave its bound by next to nothing
  const Bounds& bounds = task_.formulation.bounds();
  for (std::size_t i = 0; i < n_; ++i) {
    if (!held_[i]) continue;
    const bool full = solution_[i] > (bounds.lower[i] + bounds.upper[i]) / 2;
    if (full ? distance[i] < far : distance[i] > -far) continue;
    if (released.empty()) released.assign(n_, 0);
    released[i] = 1;
  }
  return released;
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
  std::ranges::copy(bounds_.lower, lower);
  std::ranges::copy(bounds_.upper, upper);
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

}  // namespace kreisel::core
