#include "problem/turned.hpp"

#include <utility>

namespace kreisel::core {

Turned::Turned(std::unique_ptr<Problem> inner, const Eigen::Matrix3d& R, const Vec3& t)
    : Turned(std::move(inner), moment_map(R, t)) {}

Turned::Turned(std::unique_ptr<Problem> inner, const Matrix10& map)
    : inner_(std::move(inner)), map_(map), constraints_(inner_->constraints()) {
  constraints_.matrix = inner_->constraints().matrix * map_;
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
  return std::unique_ptr<Problem>(new Turned(std::move(inside), map_));
}

std::string Turned::scope(const MassModel& mass) const {
  return inner_->scope({map_ * mass.fixed, mass.contrast, map_ * mass.interior});
}

}  // namespace kreisel::core
