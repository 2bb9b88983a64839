// torus_domain.hpp - a domain for the tests of cells.
#pragma once

#include <Eigen/Core>

#include "domain/columns.hpp"
#include "domain/test_bodies.hpp"

namespace kreisel::core {

/// Two runs in many columns, more columns in a row than a vector is long, a grid of 6 levels that it does not
/// fill, and a spacing that is no power of two.
inline const Columns& torus() {
  static const Columns domain = [] {
    GridSpec spec;
    spec.resolution = 41;
    return make_columns(body_of(moved(upright_torus_mesh(0.7, 0.28, 48, 24), Eigen::Matrix3d::Identity(),
                                      Vec3(0.05, -0.02, 0.98))),
                        spec, {1, Wall::cells});
  }();
  return domain;
}

}  // namespace kreisel::core
