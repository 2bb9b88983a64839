#include "fabricate/voids.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "body/test_meshes.hpp"
#include "domain/test_bodies.hpp"
#include "fabricate/void_surface.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
constexpr double round_off = 1e-12;  // sums of a few dozen products of numbers up to 10

TriangleMesh box(const Vec3& lo, const Vec3& hi) { return box_mesh(lo, hi); }

TriangleMesh cavity(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh = box_mesh(lo, hi);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

const TriangleMesh outer = box({0, 0, 0}, {10, 10, 10});

TEST(Voids, ASolidHasNone) {
  const Voids none = find_voids({outer}, axes);
  EXPECT_TRUE(none.pieces.empty() && none.islands.empty() && none.cuts.empty());
  EXPECT_EQ(none.text(), "none");
}

TEST(Voids, AreCountedMeasuredAndOpenedTogetherWhereAPlaneMeetsAll) {
  // Side by side in x and overlapping in z for 1 < z < 2: one cut across z, at the middle of that.
  const Voids two = find_voids({outer, cavity({1, 1, 1}, {3, 3, 4}), cavity({5, 6, 0.5}, {9, 9, 2})}, axes);
  ASSERT_EQ(two.pieces.size(), 2u);
  EXPECT_NEAR(two.pieces[0], 18, round_off);
  EXPECT_NEAR(two.pieces[1], 12, round_off);
  EXPECT_TRUE(two.islands.empty());
  ASSERT_EQ(two.cuts.size(), 1u);
  EXPECT_EQ(two.cuts[0].normal, Vec3::UnitZ());
  EXPECT_NEAR(two.cuts[0].offset, 1.5, round_off);
  EXPECT_EQ(two.cuts[0].opens, 2u);
}

TEST(Voids, ApartInEveryDirectionNeedACutEachUnlessAnotherDirectionIsAllowed) {
  // Along the diagonal no two overlap in x, y or z; across 1,-1,0 all three lie around zero.
  const std::vector<TriangleMesh> parts = {outer, cavity({1, 1, 1}, {2, 2, 2}), cavity({4, 4, 4}, {5, 5, 5}),
                                           cavity({7, 7, 7}, {9, 9, 9})};
  EXPECT_EQ(find_voids(parts, axes).cuts.size(), 3u);
  std::vector<Vec3> more(axes.begin(), axes.end());
  more.emplace_back(2, -2, 0);
  const Voids three = find_voids(parts, more);
  ASSERT_EQ(three.cuts.size(), 1u);
  EXPECT_NEAR(three.cuts[0].offset, 0, round_off);
  EXPECT_NEAR(three.cuts[0].normal.norm(), 1, round_off);
}

TEST(Voids, HoldIslandsWhichMayHoldVoidsAgain) {
  // A void with a loose block in it, and a hole in that block.
  const Voids nested = find_voids(
      {outer, cavity({1, 1, 1}, {9, 9, 9}), box({3, 3, 3}, {7, 7, 7}), cavity({4, 4, 4}, {6, 6, 6})}, axes);
  ASSERT_EQ(nested.pieces.size(), 2u);
  EXPECT_NEAR(nested.pieces[0], 8 * 8 * 8 - 4 * 4 * 4, 1e2 * round_off);
  EXPECT_NEAR(nested.pieces[1], 8, round_off);
  ASSERT_EQ(nested.islands.size(), 1u);
  EXPECT_NEAR(nested.islands[0], 4 * 4 * 4 - 8, 1e2 * round_off);
  ASSERT_EQ(nested.cuts.size(), 1u);
  EXPECT_EQ(nested.cuts[0].opens, 2u);
}

TEST(Voids, OfVoxelsAreThoseThatHangTogetherByFaces) {
  const Body body = body_of(box_mesh({-1, -1, -1}, {1, 1, 1}));
  GridSpec spec;
  spec.resolution = 12;
  const Columns domain = make_columns(body, spec, {1, Wall::cells});
  std::mt19937 engine(3);
  for (int trial = 0; trial < 5; ++trial) {
    VoxelSet set(domain, false);
    for (std::size_t v = 0; v < set.size(); ++v) set.set(v, engine() % 10 < 6);
    make_well_composed(set);
    // By flood fill: voids, and solid pieces that do not reach the shell.
    const int n = 14;
    std::vector<int> label(static_cast<std::size_t>(n * n * n), 1);  // 1: solid, 0: void
    const auto at = [](int x, int y, int z) { return static_cast<std::size_t>((z * 14 + y) * 14 + x); };
    for (std::size_t i = 0; i < domain.intervals.size(); ++i)
      for (int k = domain.intervals[i].k0; k < domain.intervals[i].k1; ++k)
        label[at(domain.intervals[i].ix + 1, domain.intervals[i].iy + 1, k + 1)] =
            set.solid(set.first(i) + static_cast<std::size_t>(k - domain.intervals[i].k0));
    std::array<std::vector<double>, 2> pieces;
    const double cell = std::pow(domain.grid.h, 3);
    for (int start = 0; start < n * n * n; ++start) {
      const int kind = label[static_cast<std::size_t>(start)];
      if (kind < 0) continue;
      std::vector<std::array<int, 3>> stack = {{start % n, start / n % n, start / n / n}};
      label[static_cast<std::size_t>(start)] = -1;
      double volume = 0;
      while (!stack.empty()) {
        const auto c = stack.back();
        stack.pop_back();
        volume += cell;
        for (int face = 0; face < 6; ++face) {
          auto to = c;
          to[static_cast<std::size_t>(face / 2)] += face % 2 ? 1 : -1;
          if (std::min({to[0], to[1], to[2]}) < 0 || std::max({to[0], to[1], to[2]}) >= n) continue;
          if (label[at(to[0], to[1], to[2])] != kind) continue;
          label[at(to[0], to[1], to[2])] = -1;
          stack.push_back(to);
        }
      }
      pieces[static_cast<std::size_t>(kind)].push_back(volume);
    }
    pieces[1].erase(pieces[1].begin());  // the body itself, which the first cell belongs to
    for (auto& kind : pieces) std::ranges::sort(kind, std::ranges::greater());
    const Voids found = find_voids({body.local, void_surface(set)}, axes);
    ASSERT_EQ(found.pieces.size(), pieces[0].size());
    ASSERT_EQ(found.islands.size(), pieces[1].size());
    for (std::size_t i = 0; i < pieces[0].size(); ++i) EXPECT_NEAR(found.pieces[i], pieces[0][i], 1e-9);
    for (std::size_t i = 0; i < pieces[1].size(); ++i) EXPECT_NEAR(found.islands[i], pieces[1][i], 1e-9);
    std::size_t opened = 0;
    for (const Cut& cut : found.cuts) opened += cut.opens;
    EXPECT_EQ(opened, found.pieces.size());
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
