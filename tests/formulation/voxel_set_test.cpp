#include "formulation/voxel_set.hpp"

#include <gtest/gtest.h>

#include <array>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A block of n voxels that is all interior.
Columns block(const std::array<int, 3>& n) {
  Columns domain;
  domain.grid.n = n;
  domain.grid.h = 0.125;
  domain.grid.origin = {-0.5, 0.25, 1};
  for (int iy = 0; iy < n[1]; ++iy)
    for (int ix = 0; ix < n[0]; ++ix)
      domain.intervals.push_back({static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), 0, n[2]});
  domain.interior_voxels = static_cast<std::size_t>(n[0] * n[1] * n[2]);
  return domain;
}

/// A ragged domain: some columns broken in two, some missing.
Columns ragged(const std::array<int, 3>& n, Random& random) {
  Columns domain = block(n);
  domain.intervals.clear();
  domain.interior_voxels = 0;
  for (int iy = 0; iy < n[1]; ++iy)
    for (int ix = 0; ix < n[0]; ++ix) {
      int k = std::uniform_int_distribution<int>(0, 2)(random);
      while (k < n[2]) {
        const int end = std::min(n[2], k + std::uniform_int_distribution<int>(1, n[2])(random));
        domain.intervals.push_back({static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), k, end});
        domain.interior_voxels += static_cast<std::size_t>(end - k);
        k = end + 1 + std::uniform_int_distribution<int>(0, 2)(random);
      }
    }
  return domain;
}

/// Void or not, cell by cell, straight from the set; solid outside the domain.
class VoidCells {
 public:
  explicit VoidCells(const VoxelSet& set) : n_(set.domain().grid.n) {
    cells_.assign(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]), false);
    std::size_t voxel = 0;
    for (const Interval& run : set.domain().intervals)
      for (int k = run.k0; k < run.k1; ++k, ++voxel)
        cells_[static_cast<std::size_t>((k * n_[1] + run.iy) * n_[0] + run.ix)] = !set.solid(voxel);
  }
  [[nodiscard]] bool at(int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= n_[0] || y >= n_[1] || z >= n_[2]) return false;
    return cells_[static_cast<std::size_t>((z * n_[1] + y) * n_[0] + x)];
  }
  [[nodiscard]] const std::array<int, 3>& n() const { return n_; }

 private:
  std::array<int, 3> n_;
  std::vector<bool> cells_;
};

/// Pieces that the eight cells around a vertex fall into, cells of one kind that share a face being one
/// piece.
int pieces(const std::array<bool, 8>& is_void) {
  std::array<int, 8> label{};
  int count = 0;
  for (int seed = 0; seed < 8; ++seed) {
    if (label[seed]) continue;
    label[seed] = ++count;
    for (int round = 0; round < 8; ++round)
      for (int c = 0; c < 8; ++c)
        for (const int axis : {1, 2, 4})
          if (label[c] == count && is_void[c ^ axis] == is_void[c]) label[c ^ axis] = count;
  }
  return count;
}

/// The surface is a manifold when at every grid vertex void and solid are one piece each: two pieces of a
/// kind touch in an edge or in the vertex alone. Independent of how make_well_composed looks.
int pinched_vertices(const VoxelSet& set) {
  const VoidCells cells(set);
  int pinched = 0;
  for (int z = 0; z <= cells.n()[2]; ++z)
    for (int y = 0; y <= cells.n()[1]; ++y)
      for (int x = 0; x <= cells.n()[0]; ++x) {
        std::array<bool, 8> around{};
        for (int c = 0; c < 8; ++c)
          around[c] = cells.at(x - 1 + (c & 1), y - 1 + (c >> 1 & 1), z - 1 + (c >> 2));
        pinched += pieces(around) > 2;
      }
  return pinched;
}

std::size_t differences(const VoxelSet& before, const VoxelSet& after) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_FALSE(before.solid(v) && !after.solid(v)) << "voxel " << v << " was emptied";
    count += before.solid(v) != after.solid(v);
  }
  return count;
}

void expect_mended(const VoxelSet& before) {
  VoxelSet after = before;
  const int pinched = pinched_vertices(before);
  const std::size_t filled = make_well_composed(after);
  EXPECT_EQ(pinched_vertices(after), 0);
  EXPECT_EQ(filled, differences(before, after));
  EXPECT_EQ(filled == 0, pinched == 0) << "changes what is pinched, and nothing else";
  VoxelSet again = after;
  EXPECT_EQ(make_well_composed(again), 0u) << "a mended set stays";
}

TEST(WellComposed, MendsEveryOneOfTheBlocksOfEightVoxels) {
  const Columns domain = block({2, 2, 2});
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    SCOPED_TRACE(pattern);
    VoxelSet set(domain, true);
    for (std::size_t v = 0; v < 8; ++v) set.set(v, (pattern >> v & 1u) == 0);
    expect_mended(set);
  }
}

TEST(WellComposed, MendsRandomSetsOfEveryDensity) {
  Random random(41);
  for (const double density : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98})
    for (int trial = 0; trial < 6; ++trial) {
      SCOPED_TRACE(density);
      const Columns domain = trial % 2 ? block({9, 7, 8}) : ragged({9, 7, 8}, random);
      VoxelSet set(domain, true);
      for (std::size_t v = 0; v < set.size(); ++v) set.set(v, uniform(random, 0, 1) < density);
      expect_mended(set);
    }
}

TEST(WellComposed, LeavesGoodSetsAlone) {
  const Columns domain = block({5, 5, 5});
  VoxelSet all_solid(domain, true), all_void(domain, false), one_void(domain, true), one_solid(domain, false),
      half(domain, false);
  one_void.set(62, false);
  one_solid.set(62, true);
  for (std::size_t v = 0; v < half.size(); ++v) half.set(v, v % 5 < 2);
  for (VoxelSet* set : {&all_solid, &all_void, &one_void, &one_solid, &half}) {
    const VoxelSet before = *set;
    ASSERT_EQ(pinched_vertices(before), 0);
    EXPECT_EQ(make_well_composed(*set), 0u);
    EXPECT_EQ(differences(before, *set), 0u);
  }
}

TEST(WellComposed, SeesThePinchesThatItsCheckerSees) {
  // The checker itself: two voids that meet in an edge, in a corner, and two solids that do.
  const Columns domain = block({2, 2, 2});  // voxel = z + 2 (x + 2 y)
  for (const bool solid : {true, false})
    for (const std::size_t other : {std::size_t{7}, std::size_t{6}, std::size_t{5}, std::size_t{3}}) {
      VoxelSet set(domain, solid);
      set.set(0, !solid);
      set.set(other, !solid);
      EXPECT_GT(pinched_vertices(set), 0) << solid << other;
    }
}

TEST(VoxelSet, NumbersVoxelsByIntervalAndUpwards) {
  Columns domain = block({2, 1, 6});
  domain.intervals = {{0, 0, 1, 4}, {1, 0, 0, 2}, {1, 0, 3, 6}};
  domain.interior_voxels = 8;
  VoxelSet set(domain, false);
  EXPECT_EQ(set.size(), 8u);
  EXPECT_EQ(set.first(0), 0u);
  EXPECT_EQ(set.first(1), 3u);
  EXPECT_EQ(set.first(2), 5u);
  set.set(set.first(2) + 1, true);
  EXPECT_EQ(set.count_solid(), 1u);
  const Moments got = moments(set);
  const Moments want =
      box_moments({domain.grid.centre(0, 1), domain.grid.centre(1, 0), domain.grid.centre(2, 4)},
                  Vec3::Constant(domain.grid.h));
  EXPECT_EQ(got, want);
  EXPECT_EQ(moments(VoxelSet(domain, false)), Moments(Moments::Zero()));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
