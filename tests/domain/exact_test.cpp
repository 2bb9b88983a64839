#include "domain/exact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "body/models.hpp"
#include "body/models/geodesic.hpp"
#include "domain/test_bodies.hpp"
#include "error.hpp"
#include "mesh/query/distance.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

GridSpec resolution(int n) {
  GridSpec spec;
  spec.resolution = n;
  return spec;
}

Body brick(double length = 1) { return body_of(box_mesh({-0.5, -0.25, 0.125}, {0.5, 0.55, 0.725}), length); }

Body model(const char* name, int fineness = 0) {
  BodySpec spec;
  spec.model = name;
  spec.fineness = fineness;
  return make_body(spec, test_device());
}

TEST(Exact, OfABoxIsInsetByTheWallWhateverTheCells) {
  const ExactColumns domain = make_exact(brick(), resolution(10), {0.73, Wall::cells});
  EXPECT_EQ(domain.grid.n, (std::array<int, 3>{10, 8, 6}));
  EXPECT_NEAR(domain.wall, 0.073, 4 * 0x1p-53);
  // The outer columns' lines are half a cell deep: within the wall.
  ASSERT_EQ(domain.intervals.size(), 8u * 6u);
  for (const ExactInterval& run : domain.intervals) {
    EXPECT_NEAR(run.z0, 0.125 + 0.073, 1e-13);  // the offset stays a few roundings on the safe side
    EXPECT_NEAR(run.z1, 0.725 - 0.073, 1e-13);
    EXPECT_TRUE(run.ix >= 1 && run.ix < 9 && run.iy >= 1 && run.iy < 7);
  }
  const Moments want = box_moments({0, 0.15, 0.425}, {0.8, 0.6, 0.6 - 2 * 0.073});
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(domain.interior[k], want[k], 1e-13) << moment_names[k];
}

TEST(Exact, MeasuresAWallInCellsMillimetresOrPercentAlike) {
  for (const Wall wall : {Wall{0.7, Wall::cells}, Wall{2.8, Wall::millimetres}, Wall{7, Wall::percent}}) {
    const ExactColumns domain = make_exact(brick(40), resolution(10), wall);
    EXPECT_NEAR(domain.wall, 0.07, 8 * 0x1p-53) << to_string(wall);
    ASSERT_EQ(domain.intervals.size(), 48u) << to_string(wall);
    EXPECT_NEAR(domain.intervals.front().z0, 0.195, 1e-13);
  }
}

TEST(Exact, KeepsLinesThatAreAsDeepAsTheWallWhateverTheirRoundOff) {
  // Lines of the second layer are exactly 1.5 cells from the sides.
  const ExactColumns domain = make_exact(brick(), resolution(10), {1.5, Wall::cells});
  EXPECT_EQ(domain.intervals.size(), 8u * 6u);
}

TEST(Exact, IntervalsAreSortedAndDisjoint) {
  const ExactColumns domain =
      make_exact(body_of(upright_torus_mesh(0.75, 0.25, 96, 48)), resolution(40), {1.5, Wall::cells});
  bool twice = false;
  for (std::size_t i = 0; i < domain.intervals.size(); ++i) {
    const ExactInterval& run = domain.intervals[i];
    EXPECT_LT(run.z0, run.z1);
    if (i == 0) continue;
    const ExactInterval& before = domain.intervals[i - 1];
    EXPECT_LT(std::tuple(before.iy, before.ix, before.z0), std::tuple(run.iy, run.ix, run.z0));
    if (before.iy != run.iy || before.ix != run.ix) continue;
    EXPECT_LT(before.z1, run.z0);
    twice = true;
  }
  EXPECT_TRUE(twice) << "lines through the tube's top and bottom";
}

TEST(Exact, OfASphereIsASmallerSphereUpToTheFacets) {
  const TriangleMesh sphere = geodesic_sphere(32);
  // Inscribed: no point of a facet is nearer to the centre than its plane.
  double facet = 1;
  for (const auto& [i, j, k] : sphere.triangles) {
    const Vec3 &a = sphere.vertices[i], &b = sphere.vertices[j], &c = sphere.vertices[k];
    facet = std::min(facet, std::abs((b - a).cross(c - a).normalized().dot(a)));
  }
  const ExactColumns domain = make_exact(body_of(sphere), resolution(48), {4, Wall::percent});
  std::size_t ends = 0;
  for (const ExactInterval& run : domain.intervals)
    for (const double z : {run.z0, run.z1}) {
      const double r = Vec3(domain.grid.centre(0, run.ix), domain.grid.centre(1, run.iy), z).norm();
      ASSERT_LE(r, 1 - domain.wall + 1e-13);
      ASSERT_GE(r, facet - domain.wall - 1e-13);
      ++ends;
    }
  EXPECT_GT(ends, 2000u);
  EXPECT_GT(facet, 0.999);
}

TEST(Exact, PointsOfAnIntervalAreAsDeepAsTheWallAndThoseBeyondItAreNot) {
  Random random(71);
  for (const char* name : {"kitten", "duck", "teapot", "woven-ring"}) {
    const Body body = model(name);
    const ExactColumns domain = make_exact(body, resolution(80), {2, Wall::percent});
    const Grid& grid = domain.grid;
    const SurfaceDistance distance(body.local);
    for (int trial = 0; trial < 4000; ++trial) {
      const auto& run = domain.intervals[random() % domain.intervals.size()];
      const auto depth = [&](double z) {
        return distance({grid.centre(0, run.ix), grid.centre(1, run.iy), z}, 3 * domain.wall);
      };
      ASSERT_GE(depth(run.z0), domain.wall - 1e-12) << name;
      ASSERT_GE(depth(run.z1), domain.wall - 1e-12) << name;
      ASSERT_GE(depth(uniform(random, run.z0, run.z1)), domain.wall - 1e-12) << name;
      ASSERT_LT(depth(run.z0 - 1e-6 * grid.h), domain.wall) << name;
      ASSERT_LT(depth(run.z1 + 1e-6 * grid.h), domain.wall) << name;
    }
  }
}

TEST(Exact, LosesNoPartOfTheInterior) {
  // The other way round: points of the solid that are deep enough lie in an interval of their column.
  Random random(72);
  const Body body = model("kitten");
  const ExactColumns domain = make_exact(body, resolution(60), {2, Wall::percent});
  const Columns voxels = make_columns(body, resolution(60), {2, Wall::percent});
  std::size_t i = 0;
  for (const Interval& run : voxels.intervals)
    for (int k = run.k0; k < run.k1; ++k) {
      const double z = voxels.grid.centre(2, k);
      const auto before = [&](const ExactInterval& e) {
        return std::tuple(e.iy, e.ix, e.z1) < std::tuple(run.iy, run.ix, z);
      };
      while (i < domain.intervals.size() && before(domain.intervals[i])) ++i;
      ASSERT_LT(i, domain.intervals.size());
      ASSERT_EQ(domain.intervals[i].ix, run.ix);
      ASSERT_EQ(domain.intervals[i].iy, run.iy);
      ASSERT_LE(domain.intervals[i].z0, z + 2e-9 * voxels.grid.h);  // make_columns keeps 1e-9 h more
    }
}

TEST(Exact, VolumeIsThatOfTheVoxelsInTheLimit) {
  const Body body = model("kitten");
  double difference[3];
  int n = 40;
  for (double& d : difference) {
    const double exact = make_exact(body, resolution(n), {4, Wall::percent}).interior[S1];
    const double voxels = make_columns(body, resolution(n), {4, Wall::percent}).interior[S1];
    d = std::abs(exact / voxels - 1);
    n *= 2;
  }
  // Voxels miss the offset surface by half a cell at random: h per unit of area, and it averages out.
  EXPECT_LT(difference[0], 0.02);
  EXPECT_LT(difference[1], 0.01);
  EXPECT_LT(difference[2], 0.005);
}

TEST(Exact, ConvergesFasterThanItsCells) {
  const Body body = model("ellipsoid");
  const auto volume = [&](int n) { return make_exact(body, resolution(n), {2, Wall::percent}).interior[S1]; };
  const double fine = volume(320);
  // Lattice sums of a smooth convex body: h^1.5 or better, so a fifth or less for each doubling, twice.
  EXPECT_LT(std::abs(volume(80) / fine - 1), 1e-3);
  EXPECT_LT(std::abs(volume(160) / fine - 1), 4e-4);
}

TEST(Exact, InteriorMomentsAreTheSumOverItsIntervals) {
  const ExactColumns domain =
      make_exact(body_of(upright_torus_mesh(0.75, 0.25, 48, 24)), resolution(30), {0.5, Wall::cells});
  const double h = domain.grid.h;
  Moments sum = Moments::Zero();
  for (const ExactInterval& run : domain.intervals) {
    const double x = domain.grid.centre(0, run.ix), y = domain.grid.centre(1, run.iy);
    const double z1 = h * h * (run.z1 - run.z0), z2 = h * h * (run.z1 * run.z1 - run.z0 * run.z0) / 2,
                 z3 = h * h * (std::pow(run.z1, 3) - std::pow(run.z0, 3)) / 3;
    Moments s;
    s << z1, x * z1, y * z1, z2, x * y * z1, y * z2, x * z2, (x * x + h * h / 12) * z1,
        (y * y + h * h / 12) * z1, z3;
    sum += s;
  }
  // Differences of cubes lose what is common to both ends: a few roundings of each interval's share.
  const double tolerance = static_cast<double>(domain.intervals.size()) * 16 * 0x1p-53 * sum[S1];
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(domain.interior[k], sum[k], tolerance) << moment_names[k];
}

TEST(Exact, TakesWallsThatVoxelsCannot) {
  const ExactColumns thin = make_exact(brick(), resolution(10), {1e-6, Wall::cells});
  EXPECT_NEAR(thin.interior[S1], 0.8 * 0.6 * 1.0, 1e-5);
}

TEST(Exact, OfKeptLinesIsThatOfFreshOnes) {
  const Body body = model("kitten");
  const SolidLines lines = solid_lines(body, resolution(40));
  for (const Wall wall :
       {Wall{2, Wall::percent}, {6, Wall::percent}, {0.3, Wall::cells}, {2, Wall::percent}}) {
    const ExactColumns kept = make_exact(body, lines, wall), fresh = make_exact(body, resolution(40), wall);
    EXPECT_EQ(kept.wall, fresh.wall);
    EXPECT_TRUE(std::ranges::equal(kept.intervals, fresh.intervals,
                                   [](const ExactInterval& a, const ExactInterval& b) {
                                     return a.ix == b.ix && a.iy == b.iy && a.z0 == b.z0 && a.z1 == b.z1;
                                   }));
    EXPECT_EQ(kept.interior, fresh.interior);
  }
}

TEST(Exact, RefusesAWallThatLeavesNoInterior) {
  try {
    (void)make_exact(brick(), resolution(10), {31, Wall::percent});
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("wall 31% leaves no interior in a grid of 10 x 8 x 6"), std::string::npos) << text;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
