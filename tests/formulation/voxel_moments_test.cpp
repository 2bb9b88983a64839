#include "formulation/voxel_moments.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "body/test_meshes.hpp"
#include "formulation/odd_grid.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// `count` cells all over the grid; cells may repeat, which sums do not mind.
std::vector<std::uint32_t> random_cells(const Grid& grid, std::size_t count, Random& random) {
  std::vector<std::uint32_t> cells(count);
  const auto index = [&](int axis) {
    return std::uniform_int_distribution<int>(0, grid.n[axis] - 1)(random);
  };
  for (std::uint32_t& cell : cells) {
    const int x = index(0), y = index(1), z = index(2);
    cell = pack_cell(x, y, z);
  }
  return cells;
}

std::vector<double> random_fill(std::size_t count, Random& random) {
  std::vector<double> fill(count);
  for (double& f : fill) f = uniform(random, 0, 1);
  return fill;
}

/// Moments of one full voxel.
Moments one(const Grid& grid, std::uint32_t cell) {
  return box_moments(
      {grid.centre(0, static_cast<int>(cell & 1023u)), grid.centre(1, static_cast<int>(cell >> 10 & 1023u)),
       grid.centre(2, static_cast<int>(cell >> 20))},
      Vec3::Constant(grid.h));
}

class VoxelMomentsOn : public testing::TestWithParam<bool> {
 protected:
  device::Device& device() { return GetParam() ? single_device() : test_device(); }
};

TEST_P(VoxelMomentsOn, StayWithinTheBoundOfTheReference) {
  const Grid grid = odd_grid();
  // One cell, a work-group and its borders, blocks of 1024, many groups; primes hit no boundary by accident.
  for (const std::size_t n : {1u, 2u, 63u, 64u, 65u, 997u, 1024u, 1025u, 7919u, 100003u}) {
    SCOPED_TRACE(n);
    Random random(n);
    const auto cells = random_cells(grid, n, random);
    const auto fill = random_fill(n, random);
    VoxelMoments kernel(device(), grid, cells);
    const Moments got = kernel(fill);
    const auto want = reference::voxel_moments(grid, cells, fill);
    // The reference rounds too, by some sqrt(n) units of which the worst-case bound holds more than enough.
    for (int k = 0; k < 10; ++k)
      EXPECT_LE(std::abs(got[k] - want.value[k]), kernel.bound() * want.abs_sum[k]) << moment_names[k];
  }
}

TEST_P(VoxelMomentsOn, OfOneVoxelInEveryCornerOfTheIndexRangeAreThoseOfItsBox) {
  Grid grid = odd_grid();
  grid.n = {1024, 1024, 1024};
  for (int c = 0; c < 8; ++c) {
    const std::uint32_t cell = pack_cell(c & 1 ? 1023 : 0, c & 2 ? 1023 : 0, c & 4 ? 1023 : 0);
    VoxelMoments kernel(device(), grid, {&cell, 1});
    const double half = 0.5;
    const Moments got = kernel({&half, 1});
    const auto want = reference::voxel_moments(grid, {&cell, 1}, {&half, 1});
    for (int k = 0; k < 10; ++k) {
      EXPECT_LE(std::abs(got[k] - want.value[k]), kernel.bound() * want.abs_sum[k]) << moment_names[k];
      EXPECT_NEAR(want.value[k], 0.5 * one(grid, cell)[k], 8 * 0x1p-53 * want.abs_sum[k]) << moment_names[k];
    }
  }
}

TEST_P(VoxelMomentsOn, OfAFullBlockAreThoseOfOneBox) {
  // The reference against algebra, and the kernel against the same.
  const Grid grid = odd_grid();
  std::vector<std::uint32_t> cells;
  for (int z = 5; z < 25; ++z)
    for (int y = 10; y < 40; ++y)
      for (int x = 0; x < 60; ++x) cells.push_back(pack_cell(x, y, z));
  const std::vector<double> full(cells.size(), 1.0);
  const Vec3 lo(grid.face(0, 0), grid.face(1, 10), grid.face(2, 5)),
      hi(grid.face(0, 60), grid.face(1, 40), grid.face(2, 25));
  const Moments want = box_moments((lo + hi) / 2, hi - lo);
  const auto sums = reference::voxel_moments(grid, cells, full);
  VoxelMoments kernel(device(), grid, cells);
  const Moments got = kernel(full);
  for (int k = 0; k < 10; ++k) {
    // 36000 additions one after the other, at most one rounding each.
    EXPECT_NEAR(sums.value[k], want[k], static_cast<double>(cells.size()) * 0x1p-53 * sums.abs_sum[k])
        << moment_names[k];
    EXPECT_LE(std::abs(got[k] - want[k]), kernel.bound() * sums.abs_sum[k]) << moment_names[k];
  }
}

TEST_P(VoxelMomentsOn, OfAnEmptyFillAreExactlyZero) {
  Random random(1);
  const auto cells = random_cells(odd_grid(), 7919, random);
  VoxelMoments kernel(device(), odd_grid(), cells);
  EXPECT_EQ(kernel(std::vector<double>(7919, 0.0)), Moments(Moments::Zero()));
  VoxelMoments none(device(), odd_grid(), {});
  EXPECT_EQ(none({}), Moments(Moments::Zero()));
}

TEST_P(VoxelMomentsOn, LoseNoSmallTermsBesideLargeOnes) {
  // Terms that every precision holds exactly: the bound of the summation stands alone. In each work-group's
  // block of 2048, each item adds a large term and 31 times as many that vanish beside it in plain single
  // precision; without compensation 31 * 2^-25 are lost of each one, well over the bound's 9 * 2^-24.
  Grid grid;
  grid.n = {128, 128, 256};
  grid.h = 1;
  const std::size_t n = 2048 * 2048;
  std::vector<std::uint32_t> cells(n);
  std::vector<double> fill(n);
  double want = 0;
  for (std::size_t i = 0; i < n; ++i) {
    cells[i] =
        pack_cell(static_cast<int>(i % 128), static_cast<int>(i / 128 % 128), static_cast<int>(i / 16384));
    fill[i] = i % 2048 < 64 ? 1 : 0x1p-25;
    want += fill[i];
  }
  const device::PartialRows rows(device(), n);
  ASSERT_EQ(rows.block(), 2048) << "the test is laid out for this block";
  VoxelMoments kernel(device(), grid, cells);
  EXPECT_LE(std::abs(kernel(fill)[S1] - want), rows.summation_bound() * want);
  if (device().single()) {
    EXPECT_LT(rows.summation_bound(), 15 * 0x1p-24) << "else plain summation would pass";
  }
}

TEST_P(VoxelMomentsOn, RepeatAgreesBitForBit) {
  Random random(2);
  const auto cells = random_cells(odd_grid(), 100003, random);
  const auto fill = random_fill(100003, random);
  VoxelMoments kernel(device(), odd_grid(), cells);
  VoxelMoments twin(device(), odd_grid(), cells);
  const Moments first = kernel(fill);
  for (int repeat = 0; repeat < 3; ++repeat) EXPECT_EQ(kernel(fill), first);
  EXPECT_EQ(twin(fill), first);
}

TEST_P(VoxelMomentsOn, RefuseAFillOfTheWrongLength) {
  Random random(3);
  const auto cells = random_cells(odd_grid(), 65, random);
  VoxelMoments kernel(device(), odd_grid(), cells);
  for (const std::size_t wrong : {0u, 64u, 66u}) {
    try {
      (void)kernel(std::vector<double>(wrong));
      FAIL() << "accepted " << wrong;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find(std::to_string(wrong) + " values"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("65 voxels"), std::string::npos) << e.what();
    }
  }
  const std::vector<Moments> weights(2, Moments::Ones()), eleven(11, Moments::Ones());
  std::vector<double> out(2 * 65 - 1), much(11 * 65);
  EXPECT_THROW(kernel.pull_back(weights, out), std::invalid_argument);
  EXPECT_THROW(kernel.pull_back(eleven, much), std::invalid_argument) << "at most ten rows";
}

TEST_P(VoxelMomentsOn, PullBackOfUnitWeightsGivesTheMomentsOfEachVoxel) {
  // s is linear in the fill, so column i of its Jacobian is what a full voxel i weighs.
  const Grid grid = odd_grid();
  for (const std::size_t n : {1u, 65u, 997u}) {
    Random random(n);
    const auto cells = random_cells(grid, n, random);
    VoxelMoments kernel(device(), grid, cells);
    std::vector<Moments> weights;
    for (int k = 0; k < 10; ++k) weights.push_back(Moments::Unit(k));
    std::vector<double> out(10 * n);
    kernel.pull_back(weights, out);
    const double full = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const auto want = reference::voxel_moments(grid, {&cells[i], 1}, {&full, 1});
      // One term and no sum but over ten weights, nine of them zero: the bound for terms alone.
      for (std::size_t k = 0; k < 10; ++k)
        EXPECT_LE(std::abs(out[k * n + i] - want.value[static_cast<int>(k)]),
                  12 * device().unit_roundoff() * want.abs_sum[static_cast<int>(k)])
            << moment_names[k] << " of voxel " << i;
    }
  }
}

TEST_P(VoxelMomentsOn, PullBackIsLinearInItsWeights) {
  const Grid grid = odd_grid();
  Random random(4);
  const std::size_t n = 127;
  const auto cells = random_cells(grid, n, random);
  VoxelMoments kernel(device(), grid, cells);
  std::vector<Moments> weights(3);
  for (Moments& w : weights)
    for (int k = 0; k < 10; ++k) w[k] = uniform(random, -1, 1);
  std::vector<double> out(3 * n);
  kernel.pull_back(weights, out);
  const double full = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const auto voxel = reference::voxel_moments(grid, {&cells[i], 1}, {&full, 1});
    for (std::size_t r = 0; r < 3; ++r) {
      const double size = weights[r].cwiseAbs().dot(voxel.abs_sum);
      // Ten terms: 12 roundings each, one for the weight, two for product and factor, ten additions.
      EXPECT_NEAR(out[r * n + i], weights[r].dot(voxel.value), 25 * device().unit_roundoff() * size);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothPrecisions, VoxelMomentsOn, testing::Bool(),
                         [](const auto& p) { return p.param ? "single" : "standard"; });

}  // namespace THIS_FILE
}  // namespace kreisel::core
