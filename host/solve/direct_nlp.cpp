// direct_nlp.cpp - the papers' form: f and the constraints as functions of x alone.
#include <algorithm>

#include "solve/nlp.hpp"

namespace kreisel {
namespace {

class DirectNlp final : public Nlp {
 public:
  DirectNlp(const Task& task, std::vector<double> start)
      : Nlp(task, std::move(start)),
        rows_(static_cast<std::size_t>(task.problem.constraints().matrix.rows())) {
    // The rows of C as pull-back weights.
    for (std::size_t r = 0; r < rows_; ++r)
      weights_.push_back(task.mass.contrast *
                         task.problem.constraints().matrix.row(static_cast<Eigen::Index>(r)).transpose());
  }

  bool get_nlp_info(Index& n, Index& m, Index& jac, Index& hess, IndexStyleEnum& style) override {
    n = static_cast<Index>(n_);
    m = static_cast<Index>(rows_ + own_.lower.size());
    jac = static_cast<Index>(rows_ * n_ + own_.entries.size());
    hess = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    fill_bounds(x_l, x_u);
    const LinearConstraints& c = task_.problem.constraints();
    std::copy_n(c.lower.data(), rows_, g_l);
    std::copy_n(c.upper.data(), rows_, g_u);
    own_row_bounds(g_l + rows_, g_u + rows_);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::ranges::copy(start_, x);
    return true;
  }

  bool eval_f(Index, const Number* x, bool new_x, Number& value) override {
    ++evaluations_.objective;
    value = task_.problem.value(total(x, new_x));
    return true;
  }

  bool eval_grad_f(Index, const Number* x, bool new_x, Number* gradient) override {
    ++evaluations_.gradient;
    const Moments weight = task_.mass.contrast * task_.problem.gradient(total(x, new_x));
    task_.formulation.pull_back(variables(x), {&weight, 1}, {gradient, n_});
    return true;
  }

  bool eval_g(Index, const Number* x, bool new_x, Index, Number* g) override {
    ++evaluations_.constraints;
    const Eigen::VectorXd value = task_.problem.constraints().matrix * total(x, new_x);
    std::copy_n(value.data(), rows_, g);
    own_rows(x, g + rows_);
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool new_x, Index, Index, Index* row, Index* column,
                  Number* values) override {
    if (!values) {
      for (std::size_t r = 0; r < rows_; ++r)
        for (std::size_t i = 0; i < n_; ++i) {
          *row++ = static_cast<Index>(r);
          *column++ = static_cast<Index>(i);
        }
      own_structure(static_cast<Index>(rows_), row, column);
      return true;
    }
    ++evaluations_.jacobian;
    if (new_x) known_ = false;
    task_.formulation.pull_back(variables(x), weights_, {values, rows_ * n_});
    own_values(values + rows_ * n_);
    return true;
  }

 private:
  const Moments& total(const Number* x, bool new_x) {
    if (new_x || !known_) total_ = task_.mass.total(task_.formulation.moments(variables(x)));
    known_ = true;
    return total_;
  }

  std::size_t rows_;
  std::vector<Moments> weights_;
  Moments total_ = Moments::Zero();
  bool known_ = false;
};

}  // namespace

Ipopt::SmartPtr<Nlp> make_direct_nlp(const Task& task, std::vector<double> start) {
  return new DirectNlp(task, std::move(start));
}

}  // namespace kreisel
