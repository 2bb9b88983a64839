#include "domain/grid.hpp"

#include <gtest/gtest.h>

#include <string>

#include "error.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Counts = std::array<int, 3>;

GridSpec resolution(int n) {
  GridSpec spec;
  spec.resolution = n;
  return spec;
}

GridSpec cells(const Counts& n) {
  GridSpec spec;
  spec.cells = n;
  return spec;
}

/// A face lies where it should but for the few roundings of its coordinate.
constexpr double rounding = 16 * 0x1p-53;

void expect_centred_around(const Grid& grid, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = grid.face(axis, 0), hi = grid.face(axis, grid.n[axis]);
    const double size = std::max(std::abs(box.lo[axis]), std::abs(box.hi[axis])) + (hi - lo);
    EXPECT_NEAR(lo + hi, box.lo[axis] + box.hi[axis], rounding * size) << "axis " << axis;
    EXPECT_LE(lo, box.lo[axis] + 1e-9 * grid.h) << "axis " << axis << ": the box sticks out";
    EXPECT_GE(hi, box.hi[axis] - 1e-9 * grid.h) << "axis " << axis << ": the box sticks out";
    EXPECT_LT(hi - lo, box.hi[axis] - box.lo[axis] + grid.h) << "axis " << axis << ": a cell too many";
  }
}

TEST(Grid, OfAResolutionDividesTheLongestSide) {
  const Box box{{1, -2, 0.5}, {5, 0, 1.5}};
  const Grid grid = make_grid(box, resolution(64));
  EXPECT_EQ(grid.n, (Counts{64, 32, 16}));
  EXPECT_EQ(grid.h, 1 / 16.0);
  EXPECT_EQ(grid.origin, Vec3(1, -2, 0.5));
  EXPECT_EQ(grid.centre(0, 0), 1 + 1 / 32.0);
  EXPECT_EQ(grid.face(2, 16), 1.5);
}

TEST(Grid, RoundsShorterSidesUpAndCentresTheBox) {
  const Box box{{-0.5, 0, 10}, {0.5, 0.51, 10.26}};
  const Grid grid = make_grid(box, resolution(10));
  EXPECT_EQ(grid.n, (Counts{10, 6, 3}));
  expect_centred_around(grid, box);
}

TEST(Grid, ASideOfWholeCellsGainsNoneByRoundOff) {
  for (int n = 2; n <= 200; ++n) {
    const double h = 1.0 / 3;
    const Box box{{0.1, 0.2, 0.3}, {0.1 + 200 * h, 0.2 + n * h, 0.3 + h}};
    EXPECT_EQ(make_grid(box, resolution(200)).n, (Counts{200, n, 1}));
  }
}

TEST(Grid, OfGivenCountsHoldsTheBoxInTheTightestDirection) {
  const Box box{{0, 0, 0}, {80, 50, 52}};
  const Grid grid = make_grid(box, cells({80, 52, 51}));
  EXPECT_EQ(grid.n, (Counts{80, 52, 51}));
  EXPECT_EQ(grid.h, 52 / 51.0) << "the z direction is the tightest";
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(grid.face(axis, 0), box.lo[axis] + rounding * 100);
    EXPECT_GE(grid.face(axis, grid.n[axis]), box.hi[axis] - rounding * 100);
    EXPECT_NEAR(grid.face(axis, 0) + grid.face(axis, grid.n[axis]), box.extent()[axis], rounding * 100);
  }
}

void refuses(const GridSpec& spec, const std::string& part) {
  try {
    (void)make_grid({{0, 0, 0}, {1, 1, 1}}, spec);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("expected 2 to 1024"), std::string::npos) << e.what();
  }
}

TEST(Grid, RefusesCountsOutsideWhatAVoxelIndexHolds) {
  for (const int n : {-5, 0, 1, 1025}) {
    refuses(resolution(n), "resolution of " + std::to_string(n) + " cells");
    refuses(cells({8, n, 8}), "grid of " + std::to_string(n) + " cells");
  }
  EXPECT_NO_THROW((void)make_grid({{0, 0, 0}, {1, 1, 1}}, resolution(1024)));
  EXPECT_NO_THROW((void)make_grid({{0, 0, 0}, {1, 1, 1}}, cells({2, 2, 2})));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
