#include "domain/octree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Grid grid_of(int nx, int ny, int nz) {
  Grid grid;
  grid.n = {nx, ny, nz};
  grid.h = 1;
  return grid;
}

/// Cubes of a grid of 16 x 16 x 16, split at random, down to single cells; some are left out.
std::vector<Cube> random_leaves(Random& random, const Cube& cube = {0, 0, 0, 16}) {
  if (cube.edge == 1 || (cube.edge < 16 && uniform(random, 0, 1) < 0.4))
    return uniform(random, 0, 1) < 0.1 ? std::vector<Cube>{} : std::vector<Cube>{cube};
  std::vector<Cube> leaves;
  for (int part = 0; part < 8; ++part) {
    const std::vector<Cube> below = random_leaves(random, cube.child(part));
    leaves.insert(leaves.end(), below.begin(), below.end());
  }
  return leaves;
}

TEST(Octree, HasTheLevelsThatHoldTheGrid) {
  EXPECT_EQ(octree_levels(grid_of(1, 1, 1)), 0);
  EXPECT_EQ(octree_levels(grid_of(2, 1, 1)), 1);
  EXPECT_EQ(octree_levels(grid_of(5, 8, 3)), 3);
  EXPECT_EQ(octree_levels(grid_of(9, 8, 3)), 4);
  EXPECT_EQ(octree_levels(grid_of(100, 1024, 7)), 10);
}

TEST(Octree, ChildrenFillTheirParentAlongTheCurve) {
  const Cube parent{32, 96, 64, 32};
  std::uint32_t place = place_on_curve(parent);
  for (int part = 0; part < 8; ++part) {
    const Cube child = parent.child(part);
    EXPECT_EQ(child.edge, 16);
    EXPECT_EQ(child.parent(), parent);
    EXPECT_EQ(place_on_curve(child), place);
    place += 16 * 16 * 16;
  }
}

TEST(Octree, UniformCubesCoverTheGridOnceInOrder) {
  const Grid grid = grid_of(13, 7, 10);
  for (const int edge : {1, 2, 4, 16}) {
    const std::vector<Cube> cubes = uniform_cubes(grid, edge);
    EXPECT_TRUE(std::ranges::is_sorted(cubes, {}, place_on_curve));
    std::vector<int> times(13 * 7 * 10);
    for (const Cube& c : cubes)
      for (int z = c.z; z < std::min(c.z + edge, 10); ++z)
        for (int y = c.y; y < std::min(c.y + edge, 7); ++y)
          for (int x = c.x; x < std::min(c.x + edge, 13); ++x) ++times[(z * 7 + y) * 13 + x];
    EXPECT_EQ(std::ranges::count(times, 1), 13 * 7 * 10) << edge;
  }
}

TEST(Octree, SharedFacesAreThoseThatNeighbouringCellsSee) {
  Random random(71);
  for (int trial = 0; trial < 5; ++trial) {
    const std::vector<Cube> leaves = random_leaves(random);
    std::vector<int> leaf(16 * 16 * 16, -1);
    for (std::size_t i = 0; i < leaves.size(); ++i)
      for (int z = 0; z < leaves[i].edge; ++z)
        for (int y = 0; y < leaves[i].edge; ++y)
          for (int x = 0; x < leaves[i].edge; ++x)
            leaf[((leaves[i].z + z) * 16 + leaves[i].y + y) * 16 + leaves[i].x + x] = static_cast<int>(i);
    std::set<std::pair<int, int>> want;
    for (int cell = 0; cell < 16 * 16 * 16; ++cell)
      for (const auto& [step, at] : {std::pair{1, cell % 16}, {16, cell / 16 % 16}, {256, cell / 256}})
        if (at < 15 && leaf[cell] >= 0 && leaf[cell + step] >= 0 && leaf[cell] != leaf[cell + step])
          want.emplace(leaf[cell], leaf[cell + step]);
    const auto faces = shared_faces(leaves, 4);
    const std::set<std::pair<int, int>> got(faces.begin(), faces.end());
    EXPECT_EQ(got.size(), faces.size()) << "each once";
    EXPECT_EQ(got, want);
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
