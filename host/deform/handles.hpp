// handles.hpp - few numbers that move a whole shape.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <vector>

#include "deform/held.hpp"
#include "geometry/box.hpp"

namespace kreisel::core {

/// How much of a handle's displacement a point takes, and how that changes from point to point.
struct HandleWeight {
  std::uint32_t handle;
  double weight;
  Vec3 gradient;
};
using HandleWeights = std::vector<HandleWeight>;

/// Handles of a smooth motion of space: a point x goes to x + sum_k w_k(x) u_k, u_k the displacement of
/// handle k. Whatever the handles are, all else knows them through these weights.
class Handles {
 public:
  virtual ~Handles() = default;

  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Those whose weight is not zero at x.
  [[nodiscard]] virtual HandleWeights at(const Vec3& x) const = 0;
  /// Of displacements along one axis, (count, count): u^T bending u measures how far they are from a motion
  /// that is affine.
  [[nodiscard]] virtual Eigen::MatrixXd bending() const = 0;
};

/// Control points of a uniform cubic B-spline over a box of cubic spans. Those are left out that move no
/// point of the body. There is nothing to solve for, and the motion has continuous second derivatives.
/// [Sederberg, Parry, Free-form deformation of solid geometric models, SIGGRAPH 1986]
class Lattice final : public Handles {
 public:
  /// @param points  of the body  @param spans  along the longest side of their box, >= 1
  Lattice(const std::vector<Vec3>& points, int spans);

  [[nodiscard]] std::size_t count() const override { return places_.size(); }
  [[nodiscard]] HandleWeights at(const Vec3& x) const override;
  [[nodiscard]] Eigen::MatrixXd bending() const override;

 private:
  using Cell = std::array<int, 3>;
  [[nodiscard]] std::size_t slot(const Cell& c) const {
    return static_cast<std::size_t>(c[0] + n_[0] * (c[1] + n_[1] * c[2]));
  }

  Vec3 origin_;
  double span_;
  Cell n_{};                         ///< control points along each axis
  std::vector<std::int32_t> index_;  ///< of a slot's handle, or -1
  std::vector<Cell> places_;         ///< of the handles
};

/// Handles that leave a part of space where it is.
class HeldHandles final : public Handles {
 public:
  HeldHandles(std::unique_ptr<const Handles> inner, std::shared_ptr<const Held> held)
      : inner_(std::move(inner)), held_(std::move(held)) {}

  [[nodiscard]] std::size_t count() const override { return inner_->count(); }
  [[nodiscard]] HandleWeights at(const Vec3& x) const override;
  [[nodiscard]] Eigen::MatrixXd bending() const override { return inner_->bending(); }

 private:
  std::unique_ptr<const Handles> inner_;
  std::shared_ptr<const Held> held_;
};

}  // namespace kreisel::core
