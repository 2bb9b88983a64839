#include "deform/bounded_quadratic.hpp"

#include <algorithm>
#include <cmath>

#include "stop.hpp"

namespace kreisel::core {
namespace {

using Vector = Eigen::VectorXd;

/// The problem in y = x / scale, with a unit diagonal.
class Scaled {
 public:
  Scaled(const QuadraticForm& Q, const Vector& diagonal, const Vector& lower, const Vector& upper)
      : Q_(Q),
        scale_(diagonal.cwiseSqrt().cwiseInverse()),
        lower_(lower.cwiseQuotient(scale_)),
        upper_(upper.cwiseQuotient(scale_)) {}

  const Vector& product(const Vector& y) {
    stop_here();
    ++products_;
    x_ = scale_.cwiseProduct(y);
    Q_(x_, out_);
    out_ = out_.cwiseProduct(scale_);
    return out_;
  }
  [[nodiscard]] Vector within(const Vector& y) const { return y.cwiseMax(lower_).cwiseMin(upper_); }
  [[nodiscard]] Vector unscaled(const Vector& y) const { return scale_.cwiseProduct(y); }
  [[nodiscard]] Vector scaled(const Vector& x) const { return x.cwiseQuotient(scale_); }
  [[nodiscard]] int products() const { return products_; }

  /// A little more than the largest eigenvalue, by powers.
  [[nodiscard]] double most() {
    Vector v =
        Vector::NullaryExpr(scale_.size(), [](Eigen::Index i) { return static_cast<double>(i % 3) - 0.9; });
    double most = 0;
    for (int i = 0; i < 20; ++i) {
      v /= v.norm();
      v = product(v);
      most = v.norm();
    }
    return 1.1 * most;
  }

  /// What of a slope g the free entries have at y; and what the others have that would let them go.
  void part(const Vector& y, const Vector& g, Vector& free, Vector& held) const {
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const bool low = y[i] <= lower_[i], high = y[i] >= upper_[i];
      free[i] = low || high ? 0 : g[i];
      held[i] = low && high ? 0 : low ? std::min(g[i], 0.0) : high ? std::max(g[i], 0.0) : 0;
    }
  }
  /// The most a step along -d may be long.
  [[nodiscard]] double room(const Vector& y, const Vector& d) const {
    double most = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      if (d[i] > 0) most = std::min(most, (y[i] - lower_[i]) / d[i]);
      if (d[i] < 0) most = std::min(most, (y[i] - upper_[i]) / d[i]);
    }
    return most;
  }
  [[nodiscard]] double residual(const Vector& y, const Vector& g) const {
    return unscaled(y - within(y - g)).lpNorm<Eigen::Infinity>();
  }
  /// free . (y - within(y - step free)) / step: what a step down it promises.
  [[nodiscard]] double promise(const Vector& y, const Vector& free, double step) const {
    return free.dot(y - within(y - step * free)) / step;
  }

 private:
  const QuadraticForm& Q_;
  Vector scale_, lower_, upper_, x_, out_;
  int products_ = 0;
};

}  // namespace

BoundedMinimum bounded_minimum(const QuadraticForm& Q, const Vector& diagonal, const Vector& lower,
                               const Vector& upper, const Vector& start, const BoundedOptions& options) {
  Scaled problem(Q, diagonal, lower, upper);
  const double step = 1.9 / problem.most();
  Vector y = problem.within(problem.scaled(start)), free(y.size()), held(y.size());
  Vector g = problem.product(y);
  problem.part(y, g, free, held);
  Vector p = free;
  double residual = problem.residual(y, g);
  while (residual > options.tolerance && problem.products() < options.most_products) {
    const bool let_go = held.squaredNorm() > problem.promise(y, free, step);
    const Vector& along = let_go ? held : p;
    const Vector& product = problem.product(along);
    const double curved = along.dot(product);
    const double best = curved > 0 ? g.dot(along) / curved : std::numeric_limits<double>::infinity();
    const double room = problem.room(y, along), length = std::min(best, room);
    if (!std::isfinite(length)) break;
    y = problem.within(y - length * along);
    g -= length * product;
    if (!let_go && best <= room) {
      problem.part(y, g, free, held);
      p = free - free.dot(product) / curved * p;
    } else {
      if (!let_go) {
        problem.part(y, g, free, held);
        y = problem.within(y - step * free);
      }
      g = problem.product(y);
      problem.part(y, g, free, held);
      p = free;
    }
    residual = problem.residual(y, g);
  }
  g = problem.product(y);  // what was updated has drifted
  return {problem.unscaled(y), problem.residual(y, g)};
}

}  // namespace kreisel::core
