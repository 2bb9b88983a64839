#include "formulation/cell_moments.hpp"

#include <gtest/gtest.h>

#include "formulation/torus_domain.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// What moments_of() and a sum of boxes may be off by: 32 roundings of terms no larger than these.
Moments tolerance(const Cube& cube, const CubeSums& sums) {
  const Grid& grid = torus().grid;
  const Vec3 reach = grid.origin.cwiseAbs() * 2 + Vec3::Constant(grid.h * (cube.edge + 64));
  const double volume = grid.h * grid.h * grid.h * static_cast<double>(voxels(sums));
  return 32 * 0x1p-53 * volume * box_moments(reach, Vec3::Constant(grid.h)) / (grid.h * grid.h * grid.h);
}

class CellMomentsOn : public testing::TestWithParam<bool> {
 protected:
  CellMoments kernel_{GetParam() ? single_device() : test_device(), torus(), 0};
};

TEST_P(CellMomentsOn, AreThoseOfTheReferenceForCubesOfEverySize) {
  for (const int edge : {1, 2, 4, 8, 16, 32, 64, 256}) {
    const std::vector<Cube> cubes = uniform_cubes(torus().grid, edge);
    const std::vector<CubeSums> got = kernel_(cubes);
    const std::vector<Moments> want = reference::cell_moments(torus(), cubes);
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t c = 0; c < cubes.size(); ++c) {
      const Moments moments = moments_of(torus().grid, cubes[c], got[c]), bound = tolerance(cubes[c], got[c]);
      for (int k = 0; k < 10; ++k)
        ASSERT_LE(std::abs(moments[k] - want[c][k]), bound[k]) << edge << ", " << moment_names[k];
    }
  }
}

TEST_P(CellMomentsOn, OfACubeAreExactlyTheSumOfItsParts) {
  for (const int edge : {2, 8, 64}) {
    std::vector<Cube> cubes = uniform_cubes(torus().grid, edge), children;
    for (const Cube& cube : cubes)
      for (int part = 0; part < 8; ++part)
        children.push_back(cube.child(part));  // some beyond the grid, without a voxel
    const std::vector<CubeSums> whole = kernel_(cubes), parts = kernel_(children);
    std::size_t next = 0;
    for (std::size_t c = 0; c < cubes.size(); ++c) {
      CubeSums sum{};
      for (; next < children.size() && children[next].parent() == cubes[c]; ++next)
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += in_parent(parts[next], children[next])[k];
      ASSERT_EQ(sum, whole[c]) << edge;
    }
    EXPECT_EQ(next, children.size());
  }
}

TEST_P(CellMomentsOn, OfFewColumnsAreTheHostsToTheLastDigit) {
  CellMoments host(test_device(), torus(), SIZE_MAX);
  for (const int edge : {1, 2, 8, 32}) {
    std::vector<Cube> cubes;
    for (const Cube& cube : uniform_cubes(torus().grid, 2 * edge))
      for (int part = 0; part < 8; ++part) cubes.push_back(cube.child(part));  // some beyond the grid
    EXPECT_EQ(host(cubes), kernel_(cubes)) << edge;
  }
}

TEST_P(CellMomentsOn, OfCubesWithoutShellAreTheClosedForm) {
  std::size_t full = 0;
  for (const int edge : {1, 2, 4}) {
    const std::vector<Cube> cubes = uniform_cubes(torus().grid, edge);
    for (const CubeSums& sums : kernel_(cubes))
      if (voxels(sums) == static_cast<std::uint64_t>(edge) * edge * edge) {
        ASSERT_EQ(sums, full_cube(edge));
        ++full;
      }
  }
  EXPECT_GT(full, 1000u);
}

TEST_P(CellMomentsOn, FillTheLargestCubeWithoutOverflow) {
  Columns block;
  block.grid.n = {256, 256, 256};
  block.grid.h = 1;
  for (int iy = 0; iy < 256; ++iy)
    for (int ix = 0; ix < 256; ++ix)
      block.intervals.push_back({static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), 0, 256});
  const Cube cube{0, 0, 0, 256};
  EXPECT_EQ(CellMoments(GetParam() ? single_device() : test_device(), block, 0)({&cube, 1})[0],
            full_cube(256));
}

TEST_P(CellMomentsOn, OfNoCubesAreNone) { EXPECT_TRUE(kernel_({}).empty()); }

INSTANTIATE_TEST_SUITE_P(, CellMomentsOn, testing::Bool());

}  // namespace THIS_FILE
}  // namespace kreisel::core
