// turned.hpp - a problem posed in another frame than the one its domain lies in.
#pragma once

#include <memory>

#include "problem/problem.hpp"

namespace kreisel::core {

/// The moments of a solid in the frame x' = R x + t are T s, linear in those in x. So a problem of x' is the
/// problem of x with f'(s) = f(T s), gradient T^T g, Hessian T^T H T and rows C T: another spin axis is
/// another f and C over the same domain. [docs/map.md]
///
/// Meant for the quadric: rays along z see an optimum that is cut along another direction, so Traits say no
/// more than `either_end` for a plane, and an interval may keep a piece at both ends for `segment`.
class Turned final : public Problem {
 public:
  /// @param inner  the problem in x'
  /// @param R, t   from the domain's frame to the problem's, body units; R a rotation
  Turned(std::unique_ptr<Problem> inner, const Eigen::Matrix3d& R, const Vec3& t);

  [[nodiscard]] std::string_view name() const override { return inner_->name(); }
  [[nodiscard]] Convexity convexity() const override { return inner_->convexity(); }
  [[nodiscard]] Traits traits() const override;
  [[nodiscard]] Goal goal() const override { return inner_->goal(); }
  [[nodiscard]] double value(const Moments& s) const override { return inner_->value(map_ * s); }
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] const Nonlinear* nonlinear() const override { return nonlinear_.get(); }
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments& s) const override;
  [[nodiscard]] std::string scope(const MassModel& mass) const override;
  [[nodiscard]] LinearConstraints also_asked(const Moments& s) const override;
  [[nodiscard]] Vec3 anchor() const override { return R_.transpose() * (inner_->anchor() - t_); }
  [[nodiscard]] std::string impossible() const override { return inner_->impossible(); }
  [[nodiscard]] double pose_loss(const Moments& s) const override { return inner_->pose_loss(map_ * s); }
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override {
    return inner_->verify(map_ * s, length_mm);
  }

 private:
  std::unique_ptr<Problem> inner_;
  Eigen::Matrix3d R_;
  Vec3 t_;
  Matrix10 map_;  ///< T
  LinearConstraints constraints_;
  std::unique_ptr<const Nonlinear> nonlinear_;
};

}  // namespace kreisel::core
