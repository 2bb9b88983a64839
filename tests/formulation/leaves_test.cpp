#include "formulation/leaves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "domain/test_bodies.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Columns of one or two runs, most of them whole, on a grid that is no cube: shell in many places, and
/// enough voxels for several threads.
const Columns& porous() {
  static const Columns domain = [] {
    Columns made;
    made.grid.n = {48, 40, 36};
    made.grid.h = 0.03;
    made.grid.origin = {-0.7, -0.6, 0.1};
    Random random(81);
    for (std::uint16_t iy = 0; iy < 40; ++iy)
      for (std::uint16_t ix = 0; ix < 48; ++ix) {
        const int low = static_cast<int>(uniform(random, 0, 12));
        if (uniform(random, 0, 1) < 0.05) made.intervals.push_back({ix, iy, 0, low / 2});
        made.intervals.push_back({ix, iy, uniform(random, 0, 1) < 0.05 ? low : 0, 36});
      }
    std::erase_if(made.intervals, [](const Interval& run) { return run.k0 == run.k1; });
    // A run that begins where the one before it ends is one with it.
    for (std::size_t i = 1; i < made.intervals.size(); ++i) {
      Interval &below = made.intervals[i - 1], &run = made.intervals[i];
      if (below.ix == run.ix && below.iy == run.iy && run.k0 <= below.k1) run.k0 = below.k1 + 1;
    }
    return made;
  }();
  return domain;
}

std::uint64_t all_voxels() {
  std::uint64_t sum = 0;
  for (const Interval& run : porous().intervals) sum += static_cast<std::uint64_t>(run.k1 - run.k0);
  return sum;
}

/// Every leaf's moments are the reference's; every voxel is in one of them; none is empty.
void expect_whole(const Leaves& leaves) {
  ASSERT_TRUE(std::ranges::is_sorted(leaves.cubes(), {}, place_on_curve));
  Eigen::Matrix<double, 10, Eigen::Dynamic> got;
  leaves.moments(got);
  const std::vector<Moments> want = reference::cell_moments(porous(), leaves.cubes());
  ASSERT_EQ(static_cast<std::size_t>(got.cols()), leaves.size());
  const double voxel = std::pow(porous().grid.h, 3);
  std::uint64_t sum = 0;
  for (std::size_t c = 0; c < leaves.size(); ++c) {
    ASSERT_GT(leaves.voxels(c), 0u) << c;
    sum += leaves.voxels(c);
    // Lengths are below one: of ours 64 roundings of the whole, of the reference's one a column.
    const double volume = voxel * static_cast<double>(leaves.voxels(c)),
                 roundings = 64 + std::pow(leaves.cubes()[c].edge, 2);
    ASSERT_LE((got.col(static_cast<Eigen::Index>(c)) - want[c]).cwiseAbs().maxCoeff(),
              roundings * 0x1p-53 * volume)
        << c;
  }
  EXPECT_EQ(sum, all_voxels());
}

TEST(Leaves, HoldWhatTheReferenceSaysHoweverTheyAreSplit) {
  Leaves leaves(porous(), test_device());
  Random random(82);
  for (int trial = 0; trial < 3; ++trial) {
    leaves.start(32);
    expect_whole(leaves);
    for (int round = 0; round < 5; ++round) {
      std::vector<std::uint8_t> marked;
      for (const Cube& cube : leaves.cubes())
        marked.push_back(cube.edge > 1 && (trial == 0 || uniform(random, 0, 1) < 0.7));
      const std::vector<Cube> before(leaves.cubes().begin(), leaves.cubes().end());
      const std::vector<std::uint8_t> count = leaves.split(marked);
      expect_whole(leaves);
      ASSERT_EQ(count.size(), before.size());
      std::size_t next = 0;
      for (std::size_t c = 0; c < before.size(); ++c)
        for (int part = 0; part < count[c]; ++part, ++next)
          ASSERT_EQ(marked[c] ? leaves.cubes()[next].parent() : leaves.cubes()[next], before[c]);
      ASSERT_EQ(next, leaves.size());
    }
    if (trial == 0) {
      EXPECT_EQ(leaves.size(), all_voxels()) << "all split, all voxels";
      EXPECT_GT(leaves.size(), 50000u) << "for several threads";
    }
  }
}

TEST(Leaves, AreAgainWhatTheyWereWhenAllThatWasSplitIsMerged) {
  Leaves leaves(porous(), test_device());
  leaves.start(8);
  const std::vector<Cube> before(leaves.cubes().begin(), leaves.cubes().end());
  for (int round = 0; round < 2; ++round) (void)leaves.split(std::vector<std::uint8_t>(leaves.size(), 1));
  ASSERT_EQ(leaves.cubes()[0].edge, 2);
  const auto always = [](std::size_t, std::size_t) { return true; };
  leaves.merge(leaves.siblings(8, [](std::size_t begin, std::size_t) { return begin >= 1000; }));
  expect_whole(leaves);
  EXPECT_EQ(leaves.cubes()[0].edge, 2);
  EXPECT_EQ(leaves.cubes()[leaves.size() - 1].edge, 4);
  for (int round = 0; round < 2; ++round) leaves.merge(leaves.siblings(8, always));
  expect_whole(leaves);
  EXPECT_TRUE(std::ranges::equal(leaves.cubes(), before));
  for (const Leaves::Family& family : leaves.siblings(8, always)) EXPECT_EQ(family.end - family.begin, 1u);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
