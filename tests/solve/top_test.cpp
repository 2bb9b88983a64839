// top_test.cpp - tops and yo-yos by every formulation and solver, against optima found by hand and each
// other.
#include "problem/top.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "problem/yoyo.hpp"
#include "solve/certificate.hpp"
#include "solve/ways.hpp"

namespace kreisel {
namespace {

/// A square box about a height, in cells of 1/8 with one of wall, and what is fixed: a plate in its middle.
/// By symmetry Jxx = Jyy, and the optimal quadric is z^2 < k^2 (x^2 + y^2): a double cone is cut out. With
/// r^2 = x^2 + y^2 + h^2/6 of a ray (its mean over the column) and A its area, the condition on k,
/// szz = k^2 Izz [docs/quadric.md, eq. 9: t = sqrt(2) (1/2 + k^2)], reads
///
///     szz0 + (2/3) A k^3 sum r^3 = k^2 (Izz0 + 2 A k sum r^3).
struct Spindle {
  explicit Spindle(double height) {
    GridSpec spec;
    spec.resolution = 12;
    domain = make_columns(body_of(box_mesh({-0.5, -0.5, height - 0.75}, {0.5, 0.5, height + 0.75})), spec,
                          {1.2, Wall::cells});
    const Moments plate = 0.3 * box_moments({0, 0, height}, {1, 1, 0.8});
    mass = {plate, 0.75};
    const double h = domain.grid.h, area = mass.contrast * h * h, izz = plate[SXX] + plate[SYY],
                 szz = plate[SZZ] - height * plate[SZ];
    double cubes = 0, low = 0, high = 1;
    for (const Interval& run : domain.intervals)
      cubes += std::pow(
          std::hypot(domain.grid.centre(0, run.ix), domain.grid.centre(1, run.iy), h / std::sqrt(6)), 3);
    for (int i = 0; i < 60; ++i) {
      const double k = (low + high) / 2;
      (k * k * (izz + 2 * area * k * cubes) < szz + area * k * k * k * cubes / 1.5 ? low : high) = k;
    }
    best = std::pow(std::numbers::sqrt2 * (0.5 + low * low), 2);
  }
  Columns domain;
  MassModel mass;
  double best = 0;  ///< R^2
};

class SpindleBy : public testing::TestWithParam<Way> {
 protected:
  void expect_best(const Problem& problem, const Spindle& on) {
    const auto formulation =
        make_formulation(GetParam().formulation, on.domain, problem.traits(), {}, test_device());
    const Task task{problem, *formulation, on.mass, test_device()};
    const Outcome outcome = solve(default_solver(GetParam().formulation), task, options_of(GetParam()));
    EXPECT_TRUE(outcome.termination == Termination::optimal || outcome.termination == Termination::acceptable)
        << outcome.message;
    EXPECT_LE(outcome.violation, 1e-8);
    EXPECT_GE(outcome.objective, on.best - 1e-8);
    // A voxel at the cut is filled in part, its mean height for the whole: (h/k)^2/12 of szz in the worst.
    const double voxels = GetParam().formulation == "voxel" ? 0.02 * on.best : 0;
    EXPECT_LE(outcome.objective, on.best + voxels + gap_of(task, outcome, 1)) << problem.name();
  }
};

TEST_P(SpindleBy, FindsTheConeThatIsKnownByHand) {
  expect_best(Yoyo({}), Spindle(0));
  expect_best(Top({.lower = Lower::none}), Spindle(0.9));
}

INSTANTIATE_TEST_SUITE_P(, SpindleBy, testing::ValuesIn(ways()),
                         [](const auto& p) { return name_of(p.param); });

/// A brick that stands askew and off its axis.
struct Brick {
  Brick() {
    const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.03, Vec3(0.6, 0.8, 0)).toRotationMatrix();
    const Vec3 half(0.5, 0.4, 0.625);
    const Body body = body_of(moved(box_mesh(-half, half), tilt, {0.015, -0.01, 0.65}));
    GridSpec grid;
    grid.resolution = 14;
    domain = make_columns(body, grid, {1, Wall::cells});
    mass = hollowed(body, domain.interior);
  }
  Columns domain;
  MassModel mass;
};

TEST(AngleForm, HasTheOptimumOfTheTraceForm) {
  const Brick on;
  for (const Way& way : {Way{"rayrep", "exact"}, Way{"rayrep", "limited-memory"}, Way{"voxel", "exact"},
                         Way{"voxel", "limited-memory"}})
    for (const Lower lower : {Lower::mass, Lower::none}) {
      SCOPED_TRACE(name_of(way));
      const auto formulation = make_formulation(way.formulation, on.domain, {}, {}, test_device());
      Outcome by[2];
      for (const SpinForm form : {SpinForm::trace, SpinForm::angle}) {
        const Top top({.lower = lower, .form = form});
        Outcome& outcome = by[static_cast<int>(form)];
        outcome = solve(find_solver("ipopt", way.formulation), {top, *formulation, on.mass, test_device()},
                        options_of(way));
        EXPECT_TRUE(outcome.termination == Termination::optimal ||
                    outcome.termination == Termination::acceptable)
            << outcome.message;
        EXPECT_LE(outcome.violation, 1e-7);
      }
      // Each is as near to the optimum as the tolerance that Ipopt has for the formulation.
      EXPECT_NEAR(by[1].objective, by[0].objective, 2e-5 * by[0].objective);
      EXPECT_TRUE(by[0].auxiliary.empty());
      ASSERT_EQ(by[1].auxiliary.size(), 1u);
      const double phi = by[1].auxiliary[0], c = std::cos(phi), s = std::sin(phi);
      const Moments& m = by[1].moments;
      EXPECT_NEAR(c * s * (m[SXX] - m[SYY]) + (c * c - s * s) * m[SXY], 0, 1e-6) << "eq. 6";
    }
}

TEST(AngleForm, IsRefusedBySolversThatKnowTheMomentsAlone) {
  const Top top({.form = SpinForm::angle});
  EXPECT_THROW(require_form(find_solver("moment", "quadric"), top), InputError);
  EXPECT_NO_THROW(require_form(find_solver("moment", "quadric"), Top({})));
  EXPECT_NO_THROW(require_form(find_solver("ipopt", "voxel"), top));
}

TEST(Certificate, OfAYoyoIsOneQuadric) {
  const Spindle on(0);
  const Certificate c = certify(Yoyo({.gamma_i = 2}), rays_of(on.domain), on.mass, test_device(), {});
  EXPECT_EQ(c.kind, Certificate::Kind::yoyo);
  EXPECT_EQ(c.boxes.size(), 1u);
  EXPECT_LE(c.bound, 2 * on.best + 1e-14);
  EXPECT_NEAR(c.bound, 2 * on.best, 1e-10);
  EXPECT_NEAR(c.best, 2 * on.best, 1e-10);
}

}  // namespace
}  // namespace kreisel
