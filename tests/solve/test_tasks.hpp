// test_tasks.hpp - a task whose optimum is known by hand: the lowest way to lay a given mass into a box.
#pragma once

#include <memory>
#include <string>

#include "domain/test_bodies.hpp"
#include "formulation/formulation.hpp"
#include "solve/rows.hpp"
#include "solve/solver.hpp"
#include "test_device.hpp"

namespace kreisel::core {

/// Minimise szz subject to s1 = mass, sx = sy = 0. Over a domain above z = 0 the optimum fills it from below.
class LowestMass final : public RowsProblem {
 public:
  explicit LowestMass(double mass) : RowsProblem(Goal::value, Filling::segment) {
    add("s1 = mass", Moments::Unit(S1), mass, mass);
    add("sx = 0", Moments::Unit(SX), 0, 0).add("sy = 0", Moments::Unit(SY), 0, 0);
  }
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

}  // namespace kreisel::core
