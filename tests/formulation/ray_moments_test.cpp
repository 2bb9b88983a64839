#include "formulation/ray_moments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>

#include "body/test_meshes.hpp"
#include "formulation/odd_grid.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

struct Rays {
  std::vector<std::uint32_t> columns;
  std::vector<double> x;
};

/// Segments of any length, thin ones too, over random columns; `unit` is that of x.
Rays random_rays(const Grid& grid, std::size_t count, double unit, Random& random) {
  Rays rays;
  for (std::size_t i = 0; i < count; ++i) {
    const int ix = std::uniform_int_distribution<int>(0, grid.n[0] - 1)(random);
    const int iy = std::uniform_int_distribution<int>(0, grid.n[1] - 1)(random);
    rays.columns.push_back(pack_column(ix, iy));
    const double z0 = uniform(random, -0.2, 0.8);
    const double length = i % 3 == 0 ? uniform(random, 0, 1e-3) : uniform(random, 0, 0.5);
    rays.x.push_back(z0 / unit);
    rays.x.push_back((z0 + length) / unit);
  }
  return rays;
}

struct Case {
  bool single;
  bool cell_unit;
};

std::string name_of(const Case& c) {
  return std::string(c.single ? "single" : "standard") + (c.cell_unit ? "InCells" : "InBodyLengths");
}

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << name_of(c); }

class RayMomentsOn : public testing::TestWithParam<Case> {
 protected:
  device::Device& device() { return GetParam().single ? single_device() : test_device(); }
  [[nodiscard]] double unit() const { return GetParam().cell_unit ? odd_grid().h : 1.0; }
};

TEST_P(RayMomentsOn, StayWithinTheBoundOfTheReference) {
  const Grid grid = odd_grid();
  // One ray, a work-group and its borders, blocks of 1024, many groups; primes hit no boundary by accident.
  for (const std::size_t n : {1u, 2u, 63u, 64u, 65u, 997u, 1024u, 1025u, 7919u, 100003u}) {
    SCOPED_TRACE(n);
    Random random(n);
    const Rays rays = random_rays(grid, n, unit(), random);
    RayMoments kernel(device(), grid, rays.columns, unit());
    const Moments got = kernel(rays.x);
    const auto want = reference::ray_moments(grid, rays.columns, unit(), rays.x);
    // The reference rounds too, by some sqrt(n) units of which the worst-case bound holds more than enough.
    for (int k = 0; k < 10; ++k)
      EXPECT_LE(std::abs(got[k] - want.value[k]), kernel.bound() * want.abs_sum[k]) << moment_names[k];
  }
}

TEST_P(RayMomentsOn, OfABundleOfEqualSegmentsAreThoseOfOneBox) {
  const Grid grid = odd_grid();
  Rays rays;
  for (int iy = 10; iy < 40; ++iy)
    for (int ix = 0; ix < 60; ++ix) {
      rays.columns.push_back(pack_column(ix, iy));
      rays.x.push_back(0.1 / unit());
      rays.x.push_back(0.7 / unit());
    }
  const Vec3 lo(grid.face(0, 0), grid.face(1, 10), 0.1), hi(grid.face(0, 60), grid.face(1, 40), 0.7);
  const Moments want = box_moments((lo + hi) / 2, hi - lo);
  const auto sums = reference::ray_moments(grid, rays.columns, unit(), rays.x);
  RayMoments kernel(device(), grid, rays.columns, unit());
  const Moments got = kernel(rays.x);
  for (int k = 0; k < 10; ++k) {
    // 1800 additions one after the other, at most one rounding each.
    EXPECT_NEAR(sums.value[k], want[k], 1800 * 0x1p-53 * sums.abs_sum[k]) << moment_names[k];
    EXPECT_LE(std::abs(got[k] - want[k]), kernel.bound() * sums.abs_sum[k]) << moment_names[k];
  }
}

TEST_P(RayMomentsOn, OfEmptySegmentsAreExactlyZero) {
  Random random(1);
  Rays rays = random_rays(odd_grid(), 7919, unit(), random);
  for (std::size_t i = 0; i < rays.x.size(); i += 2) rays.x[i + 1] = rays.x[i];
  RayMoments kernel(device(), odd_grid(), rays.columns, unit());
  EXPECT_EQ(kernel(rays.x), Moments(Moments::Zero()));
  RayMoments none(device(), odd_grid(), {}, unit());
  EXPECT_EQ(none({}), Moments(Moments::Zero()));
}

TEST_P(RayMomentsOn, OfAnInvertedSegmentAreNegative) {
  Random random(2);
  Rays rays = random_rays(odd_grid(), 97, unit(), random);
  RayMoments kernel(device(), odd_grid(), rays.columns, unit());
  const Moments up = kernel(rays.x);
  for (std::size_t i = 0; i < rays.x.size(); i += 2) std::swap(rays.x[i], rays.x[i + 1]);
  const Moments down = kernel(rays.x);
  const auto sums = reference::ray_moments(odd_grid(), rays.columns, unit(), rays.x);
  // z0 and z1 change places in sums of three terms, so last digits may differ.
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(down[k], -up[k], 2 * kernel.bound() * sums.abs_sum[k]) << moment_names[k];
}

TEST_P(RayMomentsOn, RepeatAgreesBitForBit) {
  Random random(3);
  const Rays rays = random_rays(odd_grid(), 100003, unit(), random);
  RayMoments kernel(device(), odd_grid(), rays.columns, unit());
  const Moments first = kernel(rays.x);
  for (int repeat = 0; repeat < 3; ++repeat) EXPECT_EQ(kernel(rays.x), first);
  RayMoments twin(device(), odd_grid(), rays.columns, unit());
  EXPECT_EQ(twin(rays.x), first);
}

TEST_P(RayMomentsOn, RefuseVariablesOfTheWrongLength) {
  Random random(4);
  const Rays rays = random_rays(odd_grid(), 65, unit(), random);
  RayMoments kernel(device(), odd_grid(), rays.columns, unit());
  for (const std::size_t wrong : {0u, 65u, 129u, 131u}) {
    try {
      (void)kernel(std::vector<double>(wrong));
      FAIL() << "accepted " << wrong;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find(std::to_string(wrong) + " values"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("65 rays"), std::string::npos) << e.what();
    }
  }
  const std::vector<Moments> two(2, Moments::Ones()), eleven(11, Moments::Ones());
  std::vector<double> out(129), much(11 * 130);
  EXPECT_THROW(kernel.pull_back(rays.x, two, out), std::invalid_argument);
  EXPECT_THROW(kernel.pull_back(rays.x, eleven, much), std::invalid_argument) << "at most ten rows";
  EXPECT_THROW(kernel.curvature(rays.x, Moments::Ones(), out), std::invalid_argument);
}

/// s of one ray as a function of its own two variables, in double.
Moments alone(const Rays& rays, std::size_t i, double unit, double z0, double z1) {
  const double x[2] = {z0, z1};
  return reference::ray_moments(odd_grid(), {&rays.columns[i], 1}, unit, x).value;
}

TEST_P(RayMomentsOn, PullBackMatchesCentralDifferencesOfTheReference) {
  for (const std::size_t n : {1u, 65u, 499u}) {
    Random random(n);
    const Rays rays = random_rays(odd_grid(), n, unit(), random);
    RayMoments kernel(device(), odd_grid(), rays.columns, unit());
    std::vector<Moments> weights;
    for (int k = 0; k < 10; ++k) weights.push_back(Moments::Unit(k));
    std::vector<double> out(10 * 2 * n);
    kernel.pull_back(rays.x, weights, out);
    const double area = odd_grid().h * odd_grid().h;
    // z reaches 1.3 and s is a cubic in it. With a step d, the difference is off by d^2 f'''/6 <= area d^2 /
    // 3 per body length, and by 16 roundings of s, at most 2 area, over d. d = cbrt(eps) in body lengths.
    const double d = std::cbrt(0x1p-52), difference = area * (d * d / 3 + 32 * 0x1p-53 / d);
    // The kernel: a dozen roundings of a polynomial whose terms add up to at most area (1 + 1.3)^2.
    const double tolerance = unit() * (difference + 16 * device().unit_roundoff() * area * 5.3);
    for (std::size_t i = 0; i < n; ++i) {
      const double z0 = rays.x[2 * i], z1 = rays.x[2 * i + 1], step = d / unit();
      const Moments by_z0 =
          (alone(rays, i, unit(), z0 + step, z1) - alone(rays, i, unit(), z0 - step, z1)) / (2 * step);
      const Moments by_z1 =
          (alone(rays, i, unit(), z0, z1 + step) - alone(rays, i, unit(), z0, z1 - step)) / (2 * step);
      for (std::size_t k = 0; k < 10; ++k) {
        const int m = static_cast<int>(k);
        EXPECT_NEAR(out[k * 2 * n + 2 * i], by_z0[m], tolerance) << moment_names[k] << " by z0 of ray " << i;
        EXPECT_NEAR(out[k * 2 * n + 2 * i + 1], by_z1[m], tolerance) << moment_names[k] << " by z1 of " << i;
      }
    }
  }
}

TEST_P(RayMomentsOn, CurvatureMatchesCentralDifferencesOfThePullBack) {
  const std::size_t n = 197;
  Random random(5);
  const Rays rays = random_rays(odd_grid(), n, unit(), random);
  RayMoments kernel(device(), odd_grid(), rays.columns, unit());
  RayMoments standard(test_device(), odd_grid(), rays.columns, unit());  // differences need all the digits
  const double area = odd_grid().h * odd_grid().h, u = test_device().unit_roundoff();
  for (int trial = 0; trial < 5; ++trial) {
    Moments w;
    for (int k = 0; k < 10; ++k) w[k] = uniform(random, -1, 1);
    std::vector<double> got(2 * n), up(2 * n), down(2 * n);
    kernel.curvature(rays.x, w, got);
    // The pull-back is a quadratic, of which a central difference is exact but for rounding: a large step.
    const double d = 0.25, step = d / unit();
    std::vector<double> above = rays.x, below = rays.x;
    for (std::size_t j = 0; j < 2 * n; ++j) {
      above[j] += step;
      below[j] -= step;
    }
    // Each derivative depends on its own variable alone, so all may move at once.
    standard.pull_back(above, {&w, 1}, up);
    standard.pull_back(below, {&w, 1}, down);
    // 32 roundings of ten terms of at most area (1 + 1.6)^2, over d, and the kernel's own.
    const double tolerance = unit() * unit() * area * 10 * 6.8 * (32 * u / d + 16 * device().unit_roundoff());
    for (std::size_t j = 0; j < 2 * n; ++j)
      EXPECT_NEAR(got[j], (up[j] - down[j]) / (2 * step), tolerance) << "variable " << j;
  }
}

/// One end of each ray varies, the other stays: (x, fixed) of `ends` from the interleaved ends.
struct Parted {
  std::vector<double> x, fixed;
};

Parted part(const Rays& rays, Ends ends) {
  Parted parted;
  for (std::size_t i = 0; i < rays.x.size(); i += 2) {
    const bool upper = ends == Ends::upper;
    parted.x.push_back(rays.x[i + (upper ? 1 : 0)]);
    parted.fixed.push_back(rays.x[i + (upper ? 0 : 1)]);
  }
  return parted;
}

TEST_P(RayMomentsOn, WithOneEndFixedStayWithinTheBoundOfTheReference) {
  const Grid grid = odd_grid();
  for (const Ends ends : {Ends::lower, Ends::upper})
    for (const std::size_t n : {1u, 64u, 65u, 1025u, 7919u}) {
      SCOPED_TRACE(testing::Message() << "ends " << static_cast<int>(ends) << ", " << n << " rays");
      Random random(n);
      const Rays rays = random_rays(grid, n, unit(), random);
      const Parted parted = part(rays, ends);
      RayMoments kernel(device(), grid, rays.columns, unit(), ends, parted.fixed);
      const Moments got = kernel(parted.x);
      const auto want = reference::ray_moments(grid, rays.columns, unit(), rays.x);
      for (int k = 0; k < 10; ++k)
        EXPECT_LE(std::abs(got[k] - want.value[k]), kernel.bound() * want.abs_sum[k]) << moment_names[k];
      // The same operations in the same order as with both ends.
      RayMoments both(device(), grid, rays.columns, unit());
      EXPECT_EQ(got, both(rays.x));
    }
}

TEST_P(RayMomentsOn, WithOneEndFixedDerivativesAreThoseOfThatEnd) {
  const Grid grid = odd_grid();
  const std::size_t n = 499, rows = 10;
  Random random(6);
  const Rays rays = random_rays(grid, n, unit(), random);
  std::vector<Moments> weights;
  Moments w;
  for (int k = 0; k < 10; ++k) {
    weights.push_back(Moments::Unit(k));
    w[k] = uniform(random, -1, 1);
  }
  RayMoments both(device(), grid, rays.columns, unit());
  std::vector<double> pulled(rows * 2 * n), curved(2 * n);
  both.pull_back(rays.x, weights, pulled);
  both.curvature(rays.x, w, curved);
  for (const Ends ends : {Ends::lower, Ends::upper}) {
    const Parted parted = part(rays, ends);
    const std::size_t end = ends == Ends::upper ? 1 : 0;
    RayMoments kernel(device(), grid, rays.columns, unit(), ends, parted.fixed);
    std::vector<double> out(rows * n), curvature(n);
    kernel.pull_back(parted.x, weights, out);
    kernel.curvature(parted.x, w, curvature);
    // With both ends they are tested against differences above; here the same expressions of the same
    // numbers.
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_EQ(out[r * n + i], pulled[r * 2 * n + 2 * i + end]) << "row " << r << ", ray " << i;
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(curvature[i], curved[2 * i + end]) << "ray " << i;
  }
}

TEST_P(RayMomentsOn, WithOneEndFixedRefuseWrongLengths) {
  Random random(7);
  const Rays rays = random_rays(odd_grid(), 65, unit(), random);
  const auto make = [&](Ends ends, std::size_t fixed) {
    return RayMoments(device(), odd_grid(), rays.columns, unit(), ends, std::vector<double>(fixed));
  };
  for (const Ends ends : {Ends::lower, Ends::upper}) {
    for (const std::size_t wrong : {0u, 64u, 66u, 130u})
      EXPECT_THROW((void)make(ends, wrong), std::invalid_argument) << wrong;
    RayMoments kernel = make(ends, 65);
    EXPECT_THROW((void)kernel(rays.x), std::invalid_argument) << "130 values where 65 vary";
  }
  EXPECT_THROW((void)make(Ends::both, 65), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(BothPrecisionsAndUnits, RayMomentsOn,
                         testing::Values(Case{false, true}, Case{false, false}, Case{true, true},
                                         Case{true, false}),
                         [](const auto& p) { return name_of(p.param); });

}  // namespace THIS_FILE
}  // namespace kreisel::core
