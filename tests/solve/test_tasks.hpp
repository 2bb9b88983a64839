// test_tasks.hpp - a task whose optimum is known by hand: the lowest way to lay a given mass into a box.
#pragma once

#include <memory>
#include <string>

#include "domain/test_bodies.hpp"
#include "formulation/formulation.hpp"
#include "solve/solver.hpp"
#include "test_device.hpp"

namespace kreisel {

/// Minimise szz subject to s1 = mass, sx = sy = 0. Over a domain above z = 0 the optimum fills it from below.
class LowestMass final : public Problem {
 public:
  explicit LowestMass(double mass) {
    constraints_.matrix.setZero(3, 10);
    constraints_.matrix(0, S1) = constraints_.matrix(1, SX) = constraints_.matrix(2, SY) = 1;
    constraints_.lower = constraints_.upper = Eigen::Vector3d(mass, 0, 0);
    constraints_.names = {"s1 = mass", "sx = 0", "sy = 0"};
  }
  [[nodiscard]] std::string_view name() const override { return "lowest mass"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] double value(const Moments& s) const override { return s[SZZ]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return Moments::Unit(SZZ); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  LinearConstraints constraints_;
};

/// The box [-0.5,0.5] x [-0.375,0.375] x [0,1.25] in cells of 1/8; its interior, one cell in from each side,
/// is 6 x 4 x 8 cells with its base at z = 1/8. All of these are exact in binary.
struct BoxDomain {
  static constexpr double h = 0.125, base = 0.125, height = 1, area = 24 * h * h;
  static constexpr int layers = 8;

  static const Columns& columns() {
    static const Columns domain = [] {
      GridSpec spec;
      spec.resolution = 10;
      return make_columns(body_of(box_mesh({-0.5, -0.375, 0}, {0.5, 0.375, 1.25})), spec, {1.2, Wall::cells});
    }();
    return domain;
  }

  /// szz at unit density of the lowest `filled` of the height, as rays see it.
  static double lowest_rays(double filled) {
    const double top = base + filled;
    return area * (top * top * top - base * base * base) / 3;
  }

  /// The same of voxels: whole layers, and the fraction of one, whose fill is spread over its height.
  static double lowest_voxels(double filled) {
    double sum = 0, left = filled;
    for (int k = 0; k < layers && left > 0; ++k, left -= h) {
      const double z = base + (k + 0.5) * h;
      sum += area * std::min(left, h) * (z * z + h * h / 12);
    }
    return sum;
  }
};

}  // namespace kreisel
