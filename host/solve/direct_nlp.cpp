// direct_nlp.cpp - the papers' form: f and the constraints as functions of x alone.
#include <algorithm>

#include "solve/nlp.hpp"

namespace kreisel::core {
namespace {

class DirectNlp final : public Nlp {
 public:
  DirectNlp(const Task& task, std::vector<double> start) : Nlp(task, std::move(start)) {
    // The rows of C as pull-back weights.
    for (const Row& row : rows_) weights_.push_back(form(row).transpose());
  }

  bool get_nlp_info(Index& n, Index& m, Index& jac, Index& hess, IndexStyleEnum& style) override {
    n = static_cast<Index>(n_ + last_count());
    m = static_cast<Index>(problem_row_count() + own_.lower.size());
    jac = static_cast<Index>(problem_row_count() * n_ + (margin() ? rows_.size() : 0) +
                             nonlinear_count() * last_count() + own_.entries.size());
    hess = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    fill_bounds(x_l, x_u);
    last_bounds(x_l + n_, x_u + n_);
    problem_row_bounds(g_l, g_u);
    own_row_bounds(g_l + problem_row_count(), g_u + problem_row_count());
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool with_z, Number* z_L, Number* z_U, Index,
                          bool with_lambda, Number* lambda) override {
    start_variables(x, with_z, z_L, z_U, with_lambda, lambda);
    if (with_z) {
      std::fill_n(z_L + n_, last_count(), 0.0);
      std::fill_n(z_U + n_, last_count(), 0.0);
    }
    last_start(total(x, true), x + n_);
    return true;
  }

  bool eval_f(Index, const Number* x, bool new_x, Number& value) override {
    ++evaluations_.objective;
    const Moments& s = total(x, new_x);
    value = margin()     ? x[n_]
            : own_form() ? own_form()->value(s, last(x + n_)) + regulariser_value(x)
                         : task_.problem.value(s) + regulariser_value(x);
    return true;
  }

  bool eval_grad_f(Index, const Number* x, bool new_x, Number* gradient) override {
    ++evaluations_.gradient;
    if (margin()) {
      if (new_x) known_ = false;
      std::fill_n(gradient, n_, 0.0);
      gradient[n_] = 1;
      return true;
    }
    const Moments& s = total(x, new_x);
    Moments weight;
    if (own_form()) {
      const Eigen::VectorXd g = own_form()->gradient(s, last(x + n_));
      weight = g.head<10>();
      std::copy(g.begin() + 10, g.end(), gradient + n_);
    } else {
      weight = task_.problem.gradient(s);
    }
    task_.pull_back(variables(x), {&weight, 1}, {gradient, n_});
    add_regulariser_gradient(x, gradient);
    return true;
  }

  bool eval_g(Index, const Number* x, bool new_x, Index, Number* g) override {
    ++evaluations_.constraints;
    problem_rows(total(x, new_x), x + n_, g);
    own_rows(x, g + problem_row_count());
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool new_x, Index, Index, Index* row, Index* column,
                  Number* values) override {
    if (!values) {
      const auto put = [&](std::size_t r, std::size_t c) {
        *row++ = static_cast<Index>(r);
        *column++ = static_cast<Index>(c);
      };
      for (std::size_t r = 0; r < problem_row_count(); ++r)
        for (std::size_t i = 0; i < n_; ++i) put(r, i);
      if (margin())
        for (std::size_t r = 0; r < rows_.size(); ++r) put(r, n_);
      for (std::size_t e = 0; e < nonlinear_count(); ++e)
        for (std::size_t i = 0; i < last_count(); ++i) put(rows_.size() + e, n_ + i);
      own_structure(static_cast<Index>(problem_row_count()), row, column);
      return true;
    }
    ++evaluations_.jacobian;
    if (new_x) known_ = false;
    Eigen::MatrixXd nonlinear;
    weights_.resize(rows_.size());
    if (own_form()) {
      nonlinear = own_form()->jacobian(total(x, new_x), last(x + n_));
      for (const auto& row_of : nonlinear.rowwise()) weights_.push_back(row_of.head<10>().transpose());
    }
    // A support polygon may have more rows than a pull-back takes at once.
    for (std::size_t r = 0; r < weights_.size(); r += Formulation::most_weights) {
      const std::size_t count = std::min(weights_.size() - r, Formulation::most_weights);
      task_.pull_back(variables(x), std::span(weights_).subspan(r, count), {values, count * n_});
      values += count * n_;
    }
    if (margin())
      for (const Row& r : rows_) *values++ = r.slope;
    for (const auto& row_of : nonlinear.rowwise())
      values = std::copy(row_of.begin() + 10, row_of.end(), values);
    own_values(values);
    return true;
  }

 private:
  [[nodiscard]] Moments lagrange_weight(std::span<const double> x,
                                        std::span<const double> multipliers) const override {
    const Moments s = task_.total(x);
    Moments weight = Moments::Zero();
    if (!margin()) weight = task_.problem.gradient(s);
    for (std::size_t r = 0; r < rows_.size(); ++r) weight += multipliers[r] * form(rows_[r]).transpose();
    if (own_form() && own_form()->variables() == 0) {
      const auto rows = static_cast<Eigen::Index>(nonlinear_count());
      weight += own_form()->jacobian(s, {}).transpose() *
                Eigen::Map<const Eigen::VectorXd>(multipliers.data() + rows_.size(), rows);
    }
    return weight;
  }
  const Moments& total(const Number* x, bool new_x) {
    if (new_x || !known_) total_ = task_.total(variables(x));
    known_ = true;
    return total_;
  }

  std::vector<Moments>
      weights_;  ///< of the constraints, and then of the nonlinear rows where they were last asked
  Moments total_ = Moments::Zero();
  bool known_ = false;
};

}  // namespace

Ipopt::SmartPtr<Nlp> make_direct_nlp(const Task& task, std::vector<double> start) {
  return new DirectNlp(task, std::move(start));
}

}  // namespace kreisel::core
