// certified_cases.hpp - small bodies with their domains, and what they can attain, for the tests of bounds.
#pragma once

#include <vector>

#include "formulation/quadric.hpp"
#include "solve/certificate.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel {

inline constexpr double gap = 1e-3;

/// A body with its domain, the columns' cells a sixteenth of the longest side.
struct Case {
  explicit Case(Body b, int resolution = 16) : body(std::move(b)) {
    GridSpec grid;
    grid.resolution = resolution;
    domain = make_columns(body, grid, {1, Wall::cells});
    mass = hollowed(body, domain.interior);
  }
  [[nodiscard]] Certificate certified(const Problem& problem, const CertifyOptions& options = {}) const {
    return certify(problem, rays_of(domain), mass, test_device(), options);
  }
  Body body;
  Columns domain;
  MassModel mass;
};

/// A brick that stands askew and off its axis.
inline Case top(double off = 0.015) {
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.03, Vec3(0.6, 0.8, 0)).toRotationMatrix();
  const Vec3 half(0.5, 0.4, 0.625);
  return Case(body_of(moved(box_mesh(-half, half), tilt, {off, -0.01, 0.65})));
}

/// A brick or a tetrahedron of any shape, askew, above the ground, more or less off its axis.
inline Case random_case(Random& random) {
  const Vec3 half = random_vec(random, 0.25, 0.6);
  TriangleMesh mesh = box_mesh(-half, half);
  if (uniform(random, 0, 1) < 0.4) {
    const Vec3 a(0.6, 0, 0), b(-0.3, 0.5, 0), c(-0.3, -0.5, 0), d(0, 0, 0.9);
    const auto near = [&](const Vec3& v) { return Vec3(v + random_vec(random, -0.1, 0.1)); };
    mesh = tetrahedron_mesh(near(a), near(b), near(c), near(d));
  }
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(uniform(random, 0, 0.5), random_vec(random, -1, 1).normalized()).toRotationMatrix();
  const double off = uniform(random, 0, 1) < 0.25 ? 0.3 : 0.03;
  Vec3 shift = random_vec(random, -off, off);
  shift[2] = 1;
  return Case(body_of(moved(mesh, tilt, shift)));
}

/// Moments that meet the problem's rows: what minimises random forms over all fillings, and mixtures.
inline std::vector<Moments> attainable(const Case& on, const Problem& problem, Random& random, int count) {
  const auto quadric = make_quadric(on.domain, {}, {}, test_device());
  TotalSupport oracle(*quadric->oracle(), on.mass, 0);
  const Rows rows = rows_of(problem.constraints(), false);
  std::vector<Moments> found;
  for (int i = 0; i < count; ++i) {
    Model model;
    for (double& q : model.linear) q = uniform(random, -1, 1);
    const DualPoint point = minimise_model(oracle, model, rows, {}, 1e-12);
    if (rows.violation(point.s) > 1e-11) continue;
    if (!found.empty()) {
      const double share = uniform(random, 0, 1);
      found.push_back(share * point.s + (1 - share) * found.back());
    }
    found.push_back(point.s);
  }
  return found;
}

}  // namespace kreisel
