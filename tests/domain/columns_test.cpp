#include "domain/columns.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "domain/test_bodies.hpp"
#include "error.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

GridSpec resolution(int n) {
  GridSpec spec;
  spec.resolution = n;
  return spec;
}

TEST(Wall, ReadsCellsPercentAndMillimetres) {
  const auto expect = [](const std::string& text, double value, Wall::Unit unit) {
    const Wall wall = parse_wall(text);
    EXPECT_EQ(wall.value, value) << text;
    EXPECT_EQ(wall.unit, unit) << text;
    const Wall again = parse_wall(to_string(wall));
    EXPECT_EQ(again.value, value) << to_string(wall);
    EXPECT_EQ(again.unit, unit) << to_string(wall);
  };
  expect("1.5h", 1.5, Wall::cells);
  expect("3h", 3, Wall::cells);
  expect("2%", 2, Wall::percent);
  expect("1.2", 1.2, Wall::millimetres);
  expect("1.2mm", 1.2, Wall::millimetres);
  expect("1e-1", 0.1, Wall::millimetres);
  expect("0.30000000000000004h", 0.1 + 0.2, Wall::cells);
}

TEST(Wall, RefusesWhatIsNoPositiveLength) {
  for (const std::string text : {"", "h", "%", "-1h", "0", "0h", "nan", "inf", "1e999", "1.5x", "1.5 h", " 1",
                                 "1.5hh", "1,5h", "0x10", "+1"}) {
    try {
      (void)parse_wall(text);
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("wall '" + text + "'"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("such as 1.5h"), std::string::npos) << e.what();
    }
  }
}

/// A box of 10 x 8 x 6 cells at resolution 10, away from the origin.
Body brick(double length = 1) { return body_of(box_mesh({-0.5, -0.25, 0.125}, {0.5, 0.55, 0.725}), length); }

void expect_bricks_interior(const Columns& domain, int layers) {
  const int nx = 10 - 2 * layers, ny = 8 - 2 * layers, nz = 6 - 2 * layers;
  EXPECT_EQ(domain.grid.n, (std::array<int, 3>{10, 8, 6}));
  EXPECT_EQ(domain.inside_voxels, 480u);
  EXPECT_EQ(domain.interior_voxels, static_cast<std::size_t>(nx * ny * nz));
  ASSERT_EQ(domain.intervals.size(), static_cast<std::size_t>(nx * ny));
  for (const Interval& run : domain.intervals) {
    EXPECT_EQ(run.k0, layers);
    EXPECT_EQ(run.k1, 6 - layers);
    EXPECT_TRUE(run.ix >= layers && run.ix < 10 - layers && run.iy >= layers && run.iy < 8 - layers);
  }
  const Moments want = box_moments({0, 0.15, 0.425}, {0.1 * nx, 0.1 * ny, 0.1 * nz});
  // A sum of at most 80 boxes of positive terms but for x, a handful of roundings each.
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(domain.interior[k], want[k], (80 + 16) * 0x1p-53 * want.cwiseAbs().maxCoeff())
        << moment_names[k];
}

TEST(Columns, OfABoxLoseOneLayerForEachCellOfWall) {
  // Cell centres lie 0.5, 1.5, 2.5 cells deep; the walls stay clear of them.
  expect_bricks_interior(make_columns(brick(), resolution(10), {1.2, Wall::cells}), 1);
  expect_bricks_interior(make_columns(brick(), resolution(10), {1.4, Wall::cells}), 1);
  expect_bricks_interior(make_columns(brick(), resolution(10), {1.6, Wall::cells}), 2);
}

TEST(Columns, KeepACentreThatIsAsDeepAsTheWallWhateverItsRoundOff) {
  // The default wall of 1.5 cells ends at the centres of the second layer, which are not nearer than it.
  expect_bricks_interior(make_columns(brick(), resolution(10), {1.5, Wall::cells}), 1);
  expect_bricks_interior(make_columns(brick(), resolution(10), {2.5, Wall::cells}), 2);
}

TEST(Columns, MeasureAWallInCellsMillimetresOrPercentAlike) {
  // One cell is 0.1 body lengths, 4 mm at 40 mm a length, and a tenth of the longest side.
  for (const Wall wall : {Wall{1.2, Wall::cells}, Wall{4.8, Wall::millimetres}, Wall{12, Wall::percent}}) {
    const Columns domain = make_columns(brick(40), resolution(10), wall);
    EXPECT_NEAR(domain.wall, 0.12, 8 * 0x1p-53) << to_string(wall);
    expect_bricks_interior(domain, 1);
  }
}

TEST(Columns, KeepAWallToCornersWithAllOfEachVoxel) {
  // Centres are 0.5, 1.5, 2.5 cells deep, corners 0.87 less.
  for (const auto& [cells, layers] :
       {std::pair{0.01, 1}, std::pair{0.6, 1}, std::pair{0.65, 2}, std::pair{1.6, 2}}) {
    const Columns domain = make_columns(brick(), resolution(10), {cells, Wall::cells, true});
    expect_bricks_interior(domain, layers);
    EXPECT_NEAR(domain.wall, cells * domain.grid.h, 1e-15) << "as asked for";
  }
}

TEST(Columns, OfAnOddGridKeepTheBoxCentred) {
  GridSpec spec;
  spec.cells = std::array{14, 12, 10};  // the box fills 10 x 8 x 6 of... the tightest direction sets h
  const Columns domain = make_columns(brick(), spec, {1.2, Wall::cells});
  EXPECT_EQ(domain.grid.n, (std::array<int, 3>{14, 12, 10}));
  const Vec3 centre = centre_of_mass(domain.interior);
  EXPECT_LE((centre - Vec3(0, 0.15, 0.425)).norm(), 1e-12) << "symmetric, so round-off only";
}

/// Counts intervals of every column.
std::map<std::pair<int, int>, std::vector<Interval>> by_column(const Columns& domain) {
  std::map<std::pair<int, int>, std::vector<Interval>> columns;
  for (const Interval& run : domain.intervals) columns[{run.ix, run.iy}].push_back(run);
  return columns;
}

TEST(Columns, OfTheLetterCHaveTwoIntervalsInItsArms) {
  const Body body = body_of(letter_c_mesh(2));
  // 24 cells of 1/8: arms 8 cells thick, the wall takes one layer from each side.
  const Columns domain = make_columns(body, resolution(24), {1.2, Wall::cells});
  EXPECT_EQ(domain.grid.n, (std::array<int, 3>{24, 16, 24}));
  EXPECT_EQ(domain.inside_voxels, 24u * 16 * 24 - 16u * 16 * 8);
  std::size_t voxels = 0;
  for (const auto& [column, runs] : by_column(domain)) {
    if (column.first < 7) {
      ASSERT_EQ(runs.size(), 1u);
      EXPECT_EQ(runs[0].k0, 1);
      EXPECT_EQ(runs[0].k1, 23);
    } else {
      ASSERT_EQ(runs.size(), 2u) << column.first << ", " << column.second;
      EXPECT_EQ(runs[0].k0, 1);
      // The inner corner rounds the wall: next to it the wall is an arc, which no centre of this grid meets.
      EXPECT_EQ(runs[0].k1, 7);
      EXPECT_EQ(runs[1].k0, 17);
      EXPECT_EQ(runs[1].k1, 23);
    }
    for (const Interval& run : runs) voxels += static_cast<std::size_t>(run.k1 - run.k0);
  }
  EXPECT_EQ(domain.interior_voxels, voxels);
  // Spine 6 x 14 x 22 and two arms 16 x 14 x 6 cells.
  EXPECT_EQ(voxels, 6u * 14 * 22 + 2u * 16 * 14 * 6);
}

TEST(Columns, OfAnUprightTorusFollowItsTube) {
  const double major = 0.75, minor = 0.25;
  const Body body = body_of(upright_torus_mesh(major, minor, 96, 48));
  ASSERT_NO_THROW(require_solid(body.local, "torus"));
  const Columns domain = make_columns(body, resolution(40), {1.5, Wall::cells});
  const Grid& grid = domain.grid;
  bool once = false, twice = false;
  std::size_t inside = 0;
  for (const auto& [column, runs] : by_column(domain)) {
    once |= runs.size() == 1;
    twice |= runs.size() == 2;
    for (const Interval& run : runs) {
      EXPECT_LT(run.k0, run.k1);
      for (int k = run.k0; k < run.k1; ++k) {
        const double x = grid.centre(0, run.ix), y = grid.centre(1, run.iy), z = grid.centre(2, k);
        // A polygonal torus lies inside the round one, so the round one's depth is at least the wall.
        EXPECT_LE(std::hypot(std::hypot(x, z) - major, y), minor - domain.wall);
        ++inside;
      }
    }
    if (runs.size() == 2) {
      EXPECT_LT(runs[0].k1, runs[1].k0);
    }
  }
  EXPECT_TRUE(once && twice);
  EXPECT_EQ(inside, domain.interior_voxels);
  // What the polygon misses of the circle is at most (major + minor) (1 - cos(pi / 96)) + minor (1 -
  // cos(pi / 48)) = 0.0011 deep: no voxel deeper than the wall by that is left out.
  std::size_t expected = 0;
  for (int iz = 0; iz < grid.n[2]; ++iz)
    for (int iy = 0; iy < grid.n[1]; ++iy)
      for (int ix = 0; ix < grid.n[0]; ++ix) {
        const double x = grid.centre(0, ix), y = grid.centre(1, iy), z = grid.centre(2, iz);
        expected += std::hypot(std::hypot(x, z) - major, y) <= minor - domain.wall - 0.0011;
      }
  EXPECT_GE(domain.interior_voxels, expected);
}

TEST(Columns, InteriorMomentsAreTheSumOverTheirVoxels) {
  const Columns domain =
      make_columns(body_of(upright_torus_mesh(0.75, 0.25, 48, 24)), resolution(30), {1.5, Wall::cells});
  Moments sum = Moments::Zero();
  for (const Interval& run : domain.intervals)
    for (int k = run.k0; k < run.k1; ++k)
      sum += box_moments(
          {domain.grid.centre(0, run.ix), domain.grid.centre(1, run.iy), domain.grid.centre(2, k)},
          Vec3::Constant(domain.grid.h));
  // n additions of numbers below one voxel's worth each: n roundings of the volume, with |x| <= 1.
  const double tolerance = static_cast<double>(domain.interior_voxels) * 0x1p-53 * sum[S1];
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(domain.interior[k], sum[k], tolerance) << moment_names[k];
}

TEST(Columns, RefuseAWallThatAVoidCouldPierce) {
  try {
    (void)make_columns(brick(), resolution(10), {0.86, Wall::cells});
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("wall 0.86h is 0.86 cells; expected at least 0.87"),
              std::string::npos)
        << e.what();
  }
  EXPECT_NO_THROW((void)make_columns(brick(), resolution(10), {0.87, Wall::cells}));
}

TEST(Columns, RefuseAWallThatLeavesNoInterior) {
  try {
    (void)make_columns(brick(), resolution(10), {30, Wall::percent});
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("wall 30% leaves no interior in a grid of 10 x 8 x 6"), std::string::npos) << text;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
