#include "formulation/quadric_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "body/test_meshes.hpp"
#include "formulation/few_rays.hpp"
#include "formulation/odd_grid.hpp"
#include "formulation/ray_moments.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Rays random_intervals(std::size_t count, Random& random) {
  Rays rays;
  rays.grid = odd_grid();
  for (std::size_t i = 0; i < count; ++i) {
    const int ix = std::uniform_int_distribution<int>(0, rays.grid.n[0] - 1)(random);
    const int iy = std::uniform_int_distribution<int>(0, rays.grid.n[1] - 1)(random);
    rays.columns.push_back(pack_column(ix, iy));
    rays.lower.push_back(uniform(random, -0.4, 0.4));
    rays.upper.push_back(rays.lower.back() +
                         (i % 3 == 0 ? uniform(random, 0, 1e-3) : uniform(random, 0, 0.7)));
  }
  return rays;
}

Moments random_quadric(Random& random) {
  Moments q;
  for (int k = 0; k < 10; ++k) q[k] = uniform(random, -1, 1);
  return q;
}

enum class Where { standard, single, host };

class QuadricMomentsOn : public testing::TestWithParam<Where> {
 protected:
  using Oracle = std::function<Support(const Moments&, bool)>;
  static device::Device& device() { return GetParam() == Where::single ? single_device() : test_device(); }
  static Oracle oracle_of(const Rays& rays) {
    if (GetParam() == Where::host) return FewRays(rays);
    return [oracle = std::make_shared<QuadricMoments>(device(), rays)](const Moments& q, bool hessian) {
      return (*oracle)(q, hessian);
    };
  }
  /// A root of q is off by some units of round-off over the slope there; slopes under 1e-3 are rare enough
  /// for random quadrics that a thousand units of the sum cover them.
  double tolerance() { return 1000 * device().unit_roundoff(); }
};

TEST_P(QuadricMomentsOn, AgreeWithTheReference) {
  for (const std::size_t n : {1u, 63u, 64u, 65u, 1025u, 20011u}) {
    SCOPED_TRACE(n);
    Random random(n);
    const Rays rays = random_intervals(n, random);
    const Oracle oracle = oracle_of(rays);
    for (int trial = 0; trial < 20; ++trial) {
      Moments q = random_quadric(random);
      if (trial % 4 == 1) q[SZZ] = 0;
      if (trial % 4 == 2) q[SZZ] = -0.0, q[SYZ] = q[SXZ] = q[SZ] = 0;
      const Support got = oracle(q, false);
      const MomentSums want = reference::quadric_moments(rays, q);
      for (int k = 0; k < 10; ++k)
        EXPECT_NEAR(got.moments[k], want.value[k], tolerance() * (want.abs_sum[k] + 1e-2 * want.abs_sum[S1]))
            << moment_names[k] << " in trial " << trial;
      EXPECT_DOUBLE_EQ(got.value, q.dot(got.moments));
      const Support full = oracle(q, true);
      EXPECT_LE((full.moments - got.moments).cwiseAbs().maxCoeff(), tolerance() * want.abs_sum.maxCoeff());
      const Matrix10 hessian = reference::quadric_hessian(rays, q);
      // 1/slope of a nearly tangent ray magnifies its root's rounding: relative to the largest entry.
      EXPECT_LE((full.hessian - hessian).cwiseAbs().maxCoeff(),
                100 * tolerance() * (1 + hessian.cwiseAbs().maxCoeff()));
    }
  }
}

TEST_P(QuadricMomentsOn, OfALeadingCoefficientThatVanishesAreThoseOfThePlane) {
  Random random(5);
  const Rays rays = random_intervals(999, random);
  const Oracle oracle = oracle_of(rays);
  Moments plane = random_quadric(random);
  plane.tail<6>().setZero();
  const Moments want = oracle(plane, false).moments;
  for (const double leading : {0.0, -0.0, 1e-300, -1e-300, 1e-30, -1e-30}) {
    Moments q = plane;
    q[SZZ] = leading;
    const Moments got = oracle(q, false).moments;
    EXPECT_LE((got - want).cwiseAbs().maxCoeff(), tolerance() * want[S1]) << leading;
  }
}

TEST_P(QuadricMomentsOn, DependOnTheDirectionOfTheQuadricAlone) {
  Random random(6);
  const Rays rays = random_intervals(999, random);
  const Oracle oracle = oracle_of(rays);
  const Moments q = random_quadric(random);
  const Support want = oracle(q, true);
  for (const double scale : {1e-200, 1e-20, 1e20, 1e200}) {
    const Support got = oracle(scale * q, true);
    EXPECT_LE((got.moments - want.moments).cwiseAbs().maxCoeff(), tolerance() * want.moments[S1]) << scale;
    EXPECT_LE((scale * got.hessian - want.hessian).cwiseAbs().maxCoeff(),
              100 * tolerance() * want.hessian.cwiseAbs().maxCoeff())
        << scale;
  }
}

TEST_P(QuadricMomentsOn, ConstantsTakeAllOrNothing) {
  Random random(7);
  const Rays rays = random_intervals(777, random);
  const Oracle oracle = oracle_of(rays);
  const MomentSums all = reference::quadric_moments(rays, -Moments::Unit(S1));
  EXPECT_LE((oracle(-Moments::Unit(S1), false).moments - all.value).cwiseAbs().maxCoeff(),
            tolerance() * all.abs_sum.maxCoeff());
  EXPECT_EQ(oracle(Moments::Unit(S1), true).moments, Moments(Moments::Zero()));
  EXPECT_EQ(oracle(Moments::Zero(), true).moments, Moments(Moments::Zero()));
  EXPECT_EQ(oracle(Moments::Unit(SZZ), true).moments, Moments(Moments::Zero()));  // a double root
  EXPECT_LE((oracle(-Moments::Unit(SZZ), false).moments - all.value).cwiseAbs().maxCoeff(),
            tolerance() * all.abs_sum.maxCoeff());
}

TEST_P(QuadricMomentsOn, AreTheSameBitForBitEveryTime) {
  Random random(9);
  const Rays rays = random_intervals(5003, random);
  const Oracle oracle = oracle_of(rays), another = oracle_of(rays);
  const Moments q = random_quadric(random);
  const Support first = oracle(q, true);
  for (const Oracle* again : {&oracle, &another}) {
    const Support got = (*again)(q, true);
    EXPECT_EQ(got.moments, first.moments);
    EXPECT_EQ(got.hessian, first.hessian);
  }
}

TEST_P(QuadricMomentsOn, OfNoRaysAreZero) {
  Rays none;
  none.grid = odd_grid();
  const Oracle oracle = oracle_of(none);
  const Support got = oracle(-Moments::Unit(S1), true);
  EXPECT_EQ(got.moments, Moments(Moments::Zero()));
  EXPECT_EQ(got.hessian, Matrix10(Matrix10::Zero()));
}

INSTANTIATE_TEST_SUITE_P(Precision, QuadricMomentsOn,
                         testing::Values(Where::standard, Where::single, Where::host), [](const auto& i) {
                           return i.param == Where::standard ? "standard"
                                  : i.param == Where::single ? "single"
                                                             : "host";
                         });

TEST(QuadricHessian, IsTheDerivativeOfTheMoments) {
  Random random(8);
  const Rays rays = random_intervals(4001, random);
  for (int trial = 0; trial < 5; ++trial) {
    const Moments q = random_quadric(random);
    const Matrix10 hessian = reference::quadric_hessian(rays, q);
    const Moments direction = random_quadric(random);
    // Central differences; rays that become tangent in between leave sqrt(step) each, a few of 4001.
    const double step = 1e-5;
    const Moments difference = (reference::quadric_moments(rays, q + step * direction).value -
                                reference::quadric_moments(rays, q - step * direction).value) /
                               (2 * step);
    EXPECT_LE((difference - hessian * direction).norm(), 2e-2 * (hessian * direction).norm()) << trial;
  }
}

TEST(QuadricHessian, OfASlabCutByAPlaneIsClosedForm) {
  // Columns over [0, 1]^2 from 0 to 1, cut at z = 1/2: ds1/dq1 = -area, dsz/dqz = -area/4, per unit of slope.
  Rays rays;
  rays.grid.n = {8, 8, 8};
  rays.grid.h = 0.125;
  for (int iy = 0; iy < 8; ++iy)
    for (int ix = 0; ix < 8; ++ix) {
      rays.columns.push_back(pack_column(ix, iy));
      rays.lower.push_back(0);
      rays.upper.push_back(1);
    }
  QuadricMoments oracle(test_device(), rays);
  Moments q = Moments::Zero();
  q[SZ] = 2, q[S1] = -1;  // slope 2
  const Support got = oracle(q, true);
  EXPECT_NEAR(got.moments[S1], 0.5, 1e-15);
  EXPECT_NEAR(got.moments[SZ], 0.125, 1e-15);
  EXPECT_NEAR(got.moments[SXX], 1.0 / 6, 1e-15);
  EXPECT_NEAR(got.hessian(S1, S1), -0.5, 1e-15);
  EXPECT_NEAR(got.hessian(SZ, SZ), -0.125, 1e-15);
  EXPECT_NEAR(got.hessian(SX, SX), -0.5 * (1.0 / 3 - 1.0 / 12 / 64), 1e-15);  // rays at the columns' centres
  EXPECT_NEAR(got.hessian(SXX, S1), -0.5 / 3, 1e-15);                         // averaged over the columns
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
