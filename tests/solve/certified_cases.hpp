// certified_cases.hpp - small bodies with their domains, and what they can attain, for the tests of bounds.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "formulation/quadric.hpp"
#include "problem/spinning.hpp"
#include "solve/certificate.hpp"
#include "solve/certify_spin.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {

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

/// A brick of volume one that stands askew and off its axis, on its smallest face.
inline Case top(double off = 0.015, int resolution = 16) {
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.03, Vec3(0.6, 0.8, 0)).toRotationMatrix();
  const Vec3 half(0.5, 0.4, 0.625);
  return Case(body_of(moved(box_mesh(-half, half), tilt, {off, -0.01, 0.65})), resolution);
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
    QuadraticModel model;
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

/// The bound of a region holds for all that is attained in it, whatever its multipliers: those of its
/// minimiser, and others that are more and more wrong. [docs/quadric.md, lemmas 2 and 3]
///
/// @param about  a region about moments that are attained
inline void expect_bounds_whatever_the_multipliers(
    const Spinning& problem, Random& random, int regions,
    const std::function<SpinRegion(const Moments& attained)>& about) {
  const Case on = top();
  const SafeSupport support(rays_of(on.domain), on.mass);
  const std::vector<Moments> all = attainable(on, problem, random, 60);
  const auto quadric = make_quadric(on.domain, {}, {}, test_device());
  TotalSupport oracle(*quadric->oracle(), on.mass, 0);
  MomentPoint near;
  near.s = all.front();
  int inside = 0;
  double closest = 1;
  for (int i = 0; i < regions; ++i) {
    const SpinRegion region = about(all[static_cast<std::size_t>(i) % all.size()]);
    BoxMultipliers m = minimise_box(oracle, problem.weights(), region, near).multipliers;
    const double noise = i % 4 == 0 ? 0 : std::pow(10.0, -(i % 4));
    for (double& u : m.u) u += uniform(random, -noise, noise);
    for (double& mu : m.mu) mu += uniform(random, -noise, noise);
    m.nu_low += uniform(random, -noise, noise);  // of any sign
    if (region.confines_sz()) m.kappa += uniform(random, -noise, noise);
    const CertifiedBox box = certify_box(support, problem.weights(), region, m);
    EXPECT_FALSE(box.empty);
    for (const Moments& s : all) {
      const double height = centre_of_mass(s)[2];
      if (height < region.low || height > region.high || s[SZ] < region.sz_low || s[SZ] > region.sz_high)
        continue;
      ++inside;
      EXPECT_LE(box.value, problem.value(s));
      closest = std::min(closest, problem.value(s) - box.value);
    }
  }
  EXPECT_GE(inside, regions);
  EXPECT_LT(closest, 0.3) << "bounds that far off say nothing";
}

/// Of 40 random bodies each is certified to within the gap, below whatever is attained, or shown to be
/// infeasible. @return  how many are feasible
inline int expect_certified_or_separated(Random& random,
                                         const std::function<std::unique_ptr<Problem>(int i)>& make) {
  int feasible = 0;
  for (int i = 0; i < 40; ++i) {
    const Case on = random_case(random);
    const std::unique_ptr<Problem> problem = make(i);
    const Certificate c = on.certified(*problem, {.gap = gap});
    if (c.kind == Certificate::Kind::infeasible) {
      EXPECT_GT(c.separation, 0) << i;
      continue;
    }
    ++feasible;
    EXPECT_TRUE(c.reached) << i << ": " << c.message << ", " << c.bound << " .. " << c.best;
    EXPECT_LE(c.bound, c.best) << i;
    for (const Moments& s : attainable(on, *problem, random, 5)) EXPECT_LE(c.bound, problem->value(s)) << i;
  }
  return feasible;
}

}  // namespace kreisel::core
