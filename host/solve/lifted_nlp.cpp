// lifted_nlp.cpp - the ten moments as variables: f acts on ten numbers, and only s = s(x) knows the domain.
#include <algorithm>

#include "solve/nlp.hpp"

namespace kreisel::core {
namespace {

constexpr std::size_t ten = 10;

class LiftedNlp final : public Nlp {
 public:
  LiftedNlp(const Task& task, std::vector<double> start, bool convexify)
      : Nlp(task, std::move(start)), convexify_(convexify), linear_(task.formulation.moments_are_linear()) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto row = form(rows_[r]);
      for (int k = 0; k < row.size(); ++k)
        if (row[k] != 0) entries_.push_back({static_cast<int>(r), k, row[k]});
      if (rows_[r].slope != 0)
        entries_.push_back({static_cast<int>(r), static_cast<int>(ten), rows_[r].slope});
    }
    for (std::size_t k = 0; k < ten; ++k) weights_.push_back(Moments::Unit(static_cast<int>(k)));
  }

  bool get_nlp_info(Index& n, Index& m, Index& jac, Index& hess, IndexStyleEnum& style) override {
    n = static_cast<Index>(n_ + ten + last_count());
    m = static_cast<Index>(ten + problem_row_count() + own_.lower.size());
    jac = static_cast<Index>(ten * n_ + ten + entries_.size() + nonlinear_count() * (ten + last_count()) +
                             own_.entries.size());
    hess = static_cast<Index>((linear_ ? 0 : n_) + curved_count() * (curved_count() + 1) / 2 +
                              regulariser().size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    fill_bounds(x_l, x_u);
    std::fill_n(x_l + n_, ten, -infinity);
    std::fill_n(x_u + n_, ten, infinity);
    last_bounds(x_l + n_ + ten, x_u + n_ + ten);
    std::fill_n(g_l, ten, 0.0);
    std::fill_n(g_u, ten, 0.0);
    problem_row_bounds(g_l + ten, g_u + ten);
    own_row_bounds(g_l + ten + problem_row_count(), g_u + ten + problem_row_count());
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool with_z, Number* z_L, Number* z_U, Index,
                          bool with_lambda, Number* lambda) override {
    start_variables(x, with_z, z_L, z_U, with_lambda, lambda);
    if (with_z) {
      std::fill_n(z_L + n_, ten + last_count(), 0.0);
      std::fill_n(z_U + n_, ten + last_count(), 0.0);
    }
    const Moments s = task_.total(start_);
    std::copy_n(s.data(), ten, x + n_);
    last_start(s, x + n_ + ten);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    ++evaluations_.objective;
    value = margin()     ? x[n_ + ten]
            : own_form() ? own_form()->value(lifted(x), last(x + n_ + ten)) + regulariser_value(x)
                         : task_.problem.value(lifted(x)) + regulariser_value(x);
    return true;
  }

  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    ++evaluations_.gradient;
    std::fill_n(gradient, n_ + ten + last_count(), 0.0);
    if (margin())
      gradient[n_ + ten] = 1;
    else if (own_form())
      std::ranges::copy(own_form()->gradient(lifted(x), last(x + n_ + ten)), gradient + n_);
    else
      std::ranges::copy(task_.problem.gradient(lifted(x)), gradient + n_);
    add_regulariser_gradient(x, gradient);
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    ++evaluations_.constraints;
    const Moments s = lifted(x);
    const Moments gap = task_.total(variables(x)) - s;
    std::copy_n(gap.data(), ten, g);
    problem_rows(s, x + n_ + ten, g + ten);
    own_rows(x, g + ten + problem_row_count());
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* row, Index* column,
                  Number* values) override {
    const Index s = static_cast<Index>(n_);
    if (!values) {
      const auto put = [&](std::size_t r, std::size_t c) {
        *row++ = static_cast<Index>(r);
        *column++ = static_cast<Index>(c);
      };
      for (std::size_t k = 0; k < ten; ++k)
        for (std::size_t i = 0; i < n_; ++i) put(k, i);
      for (std::size_t k = 0; k < ten; ++k) put(k, n_ + k);
      for (const SparseRows::Entry& e : entries_) put(ten + e.row, static_cast<std::size_t>(s + e.column));
      for (std::size_t e = 0; e < nonlinear_count(); ++e)
        for (std::size_t k = 0; k < ten + last_count(); ++k) put(ten + rows_.size() + e, n_ + k);
      own_structure(static_cast<Index>(ten + problem_row_count()), row, column);
      return true;
    }
    ++evaluations_.jacobian;
    if (linear_ && !constant_.empty()) {
      std::ranges::copy(constant_, values);
    } else {
      task_.pull_back(variables(x), weights_, {values, ten * n_});
      if (linear_) constant_.assign(values, values + ten * n_);
    }
    values += ten * n_;
    values = std::fill_n(values, ten, -1.0);
    for (const SparseRows::Entry& e : entries_) *values++ = e.value;
    if (own_form()) {
      const Eigen::MatrixXd nonlinear = own_form()->jacobian(lifted(x), last(x + n_ + ten));
      for (const auto& row_of : nonlinear.rowwise()) values = std::copy(row_of.begin(), row_of.end(), values);
    }
    own_values(values);
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* lambda, bool, Index,
              Index* row, Index* column, Number* values) override {
    if (!values) {
      if (!linear_)
        for (std::size_t i = 0; i < n_; ++i) *row++ = *column++ = static_cast<Index>(i);
      for (std::size_t a = 0; a < curved_count(); ++a)
        for (std::size_t b = 0; b <= a; ++b) {
          *row++ = static_cast<Index>(n_ + a);
          *column++ = static_cast<Index>(n_ + b);
        }
      for (const SparseRows::Entry& e : regulariser()) {
        *row++ = e.row;
        *column++ = e.column;
      }
      return true;
    }
    ++evaluations_.hessian;
    if (!linear_) {
      const Moments weight = task_.mass.contrast * Eigen::Map<const Moments>(lambda);
      task_.formulation.curvature(variables(x), weight, {values, n_});
      if (convexify_)
        for (std::size_t i = 0; i < n_; ++i) values[i] = std::max(values[i], 0.0);
      values += n_;
    }
    const Eigen::MatrixXd h = curved(x, factor, lambda);
    for (int a = 0; a < h.rows(); ++a)
      for (int b = 0; b <= a; ++b) *values++ = h(a, b);
    for (const SparseRows::Entry& e : regulariser()) *values++ = factor * e.value;
    return true;
  }

 private:
  /// How many variables f and the nonlinear rows curve in.
  [[nodiscard]] std::size_t curved_count() const { return ten + (own_form() ? last_count() : 0); }
  /// Hessian in them. The margin is linear in t: the structure is kept, and all is zero.
  [[nodiscard]] Eigen::MatrixXd curved(const Number* x, double factor, const Number* lambda) const {
    if (margin()) return Matrix10::Zero();
    if (!own_form()) return factor * task_.problem.hessian(lifted(x));
    const Eigen::Map<const Eigen::VectorXd> multipliers(lambda + ten + rows_.size(),
                                                        static_cast<Eigen::Index>(nonlinear_count()));
    const auto a = last(x + n_ + ten);
    return factor * own_form()->hessian(lifted(x), a) + own_form()->curvature(lifted(x), a, multipliers);
  }
  [[nodiscard]] Moments lagrange_weight(std::span<const double>,
                                        std::span<const double> multipliers) const override {
    return Eigen::Map<const Moments>(multipliers.data());
  }
  [[nodiscard]] Moments lifted(const Number* x) const { return Eigen::Map<const Moments>(x + n_); }

  bool convexify_, linear_;
  std::vector<SparseRows::Entry> entries_;  ///< non-zeros of the problem's rows in (s, t)
  std::vector<Moments> weights_;
  std::vector<double> constant_;  ///< ds/dx of a linear formulation
};

}  // namespace

Ipopt::SmartPtr<Nlp> make_lifted_nlp(const Task& task, std::vector<double> start, bool convexify) {
  return new LiftedNlp(task, std::move(start), convexify);
}

}  // namespace kreisel::core
