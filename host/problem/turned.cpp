#include "problem/turned.hpp"

#include <utility>

namespace kreisel::core {
namespace {

/// Rows and value in (s, a) of those in (T s, a).
class TurnedNonlinear final : public Nonlinear {
 public:
  TurnedNonlinear(const Nonlinear& inner, const Matrix10& map)
      : inner_(inner), map_(Eigen::MatrixXd::Identity(10 + inner.variables(), 10 + inner.variables())) {
    map_.topLeftCorner<10, 10>() = map;
  }
  [[nodiscard]] std::string asked_by() const override { return inner_.asked_by(); }
  [[nodiscard]] int variables() const override { return inner_.variables(); }
  [[nodiscard]] Eigen::VectorXd start(const Moments& s) const override { return inner_.start(turned(s)); }
  [[nodiscard]] double value(const Moments& s, const Eigen::VectorXd& a) const override {
    return inner_.value(turned(s), a);
  }
  [[nodiscard]] Eigen::VectorXd gradient(const Moments& s, const Eigen::VectorXd& a) const override {
    return map_.transpose() * inner_.gradient(turned(s), a);
  }
  [[nodiscard]] Eigen::MatrixXd hessian(const Moments& s, const Eigen::VectorXd& a) const override {
    return map_.transpose() * inner_.hessian(turned(s), a) * map_;
  }
  [[nodiscard]] const Eigen::VectorXd& lower() const override { return inner_.lower(); }
  [[nodiscard]] const Eigen::VectorXd& upper() const override { return inner_.upper(); }
  [[nodiscard]] Eigen::VectorXd rows(const Moments& s, const Eigen::VectorXd& a) const override {
    return inner_.rows(turned(s), a);
  }
  [[nodiscard]] Eigen::MatrixXd jacobian(const Moments& s, const Eigen::VectorXd& a) const override {
    return inner_.jacobian(turned(s), a) * map_;
  }
  [[nodiscard]] Eigen::MatrixXd curvature(const Moments& s, const Eigen::VectorXd& a,
                                          const Eigen::VectorXd& multipliers) const override {
    return map_.transpose() * inner_.curvature(turned(s), a, multipliers) * map_;
  }

 private:
  [[nodiscard]] Moments turned(const Moments& s) const { return map_.topLeftCorner<10, 10>() * s; }

  const Nonlinear& inner_;
  Eigen::MatrixXd map_;  ///< T, and one for each of a
};

}  // namespace

Turned::Turned(std::unique_ptr<Problem> inner, const Eigen::Matrix3d& R, const Vec3& t)
    : inner_(std::move(inner)), R_(R), t_(t), map_(moment_map(R, t)), constraints_(inner_->constraints()) {
  constraints_.matrix = inner_->constraints().matrix * map_;
  if (inner_->nonlinear()) nonlinear_ = std::make_unique<TurnedNonlinear>(*inner_->nonlinear(), map_);
}

Traits Turned::traits() const {
  const Traits inside = inner_->traits();
  return {inside.filling == Filling::from_below ? Filling::either_end : inside.filling};
}

Moments Turned::gradient(const Moments& s) const { return map_.transpose() * inner_->gradient(map_ * s); }

Matrix10 Turned::hessian(const Moments& s) const {
  const Matrix10 h = map_.transpose() * inner_->hessian(map_ * s) * map_;
  return (h + h.transpose()) / 2;  // round-off leaves the product a little unsymmetric
}

std::unique_ptr<Problem> Turned::next(const Moments& s) const {
  std::unique_ptr<Problem> inside = inner_->next(map_ * s);
  if (!inside) return nullptr;
  return std::make_unique<Turned>(std::move(inside), R_, t_);
}

LinearConstraints Turned::also_asked(const Moments& s) const {
  LinearConstraints rows = inner_->also_asked(map_ * s);
  if (rows.matrix.rows() > 0) rows.matrix *= map_;
  return rows;
}

std::string Turned::scope(const MassModel& mass) const {
  return inner_->scope({map_ * mass.fixed, mass.contrast, map_ * mass.interior});
}

}  // namespace kreisel::core
