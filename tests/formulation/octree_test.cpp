#include "formulation/octree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulation/torus_domain.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

std::unique_ptr<Formulation> make(const SettingTexts& settings = {}) {
  return make_formulation("octree", torus(), {}, settings, test_device());
}

/// Indices of the interior voxels in a cube, in the order of VoxelSet.
std::vector<std::size_t> voxels_in(const Cube& c) {
  static const VoxelSet index(torus(), false);
  std::vector<std::size_t> voxels;
  for (std::size_t i = 0; i < torus().intervals.size(); ++i) {
    const Interval& run = torus().intervals[i];
    if (run.ix < c.x || run.ix >= c.x + c.edge || run.iy < c.y || run.iy >= c.y + c.edge) continue;
    for (int k = std::max<int>(run.k0, c.z); k < std::min<int>(run.k1, c.z + c.edge); ++k)
      voxels.push_back(index.first(i) + static_cast<std::size_t>(k - run.k0));
  }
  return voxels;
}

/// Mean fills of cells: void on one side of a tilted plane, fractional voxels where it cuts them.
std::vector<double> half_void(const Formulation& f, double shift) {
  std::vector<double> fill;
  for (const Interval& run : torus().intervals)
    for (int k = run.k0; k < run.k1; ++k)
      fill.push_back(std::clamp(0.5 + (run.ix + 0.7 * run.iy + 0.4 * k - shift) / 2.1, 0.0, 1.0));
  std::vector<double> x;
  for (const Cube& c : f.cells()) {
    const std::vector<std::size_t> voxels = voxels_in(c);
    double sum = 0;
    for (const std::size_t v : voxels) sum += fill[v];
    x.push_back(sum / static_cast<double>(voxels.size()));
  }
  return x;
}

/// Splits along that plane until nothing is left to split.
std::vector<double> refine_along(Formulation& f, double shift) {
  std::vector<double> x = half_void(f, shift);
  while (f.refine(x)) x = half_void(f, shift);
  return x;
}

constexpr double shift = 33;  // through the middle of the grid

/// The moments of an interior of about unit size; each cell's are a dozen roundings off.
constexpr double round_off = 1e-13;

TEST(OctreeFormulation, HasEveryInteriorVoxelInOneLeafAfterEveryRound) {
  const auto f = make();
  std::vector<double> x = half_void(*f, shift);
  int rounds = 0;
  do {
    std::vector<int> leaf(torus().interior_voxels, 0);
    for (const Cube& c : f->cells())
      for (const std::size_t v : voxels_in(c)) ++leaf[v];
    ASSERT_TRUE(std::ranges::all_of(leaf, [](int times) { return times == 1; })) << rounds;
    const Moments all = f->moments(std::vector<double>(f->num_variables(), 1.0));
    for (int k = 0; k < 10; ++k) ASSERT_NEAR(all[k], torus().interior[k], round_off) << moment_names[k];
    x = half_void(*f, shift);
    ++rounds;
  } while (f->refine(x));
  EXPECT_EQ(rounds, 4);  // levels 3 to 6
}

TEST(OctreeFormulation, SplitsUntilOnlyVoxelsAreFractionalOrLieAlongTheVoid) {
  const auto f = make();
  const std::vector<double> x = refine_along(*f, shift);
  const std::vector<Cube> cells = f->cells();
  std::size_t along = 0, merged = 0;
  for (const auto& [low, high] : shared_faces(cells, octree_levels(torus().grid)))
    if ((x[low] >= 0.5) != (x[high] >= 0.5)) {
      EXPECT_EQ(cells[low].edge, 1);
      EXPECT_EQ(cells[high].edge, 1);
      ++along;
    }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    EXPECT_TRUE(cells[c].edge == 1 || x[c] < 0.01 || x[c] > 0.99) << c;
    merged += cells[c].edge > 1;
  }
  EXPECT_GT(along, 100u);
  EXPECT_GT(merged, 20u) << "away from the plane cells stay coarse";
  const CellCounts counts = f->count_cells(x);
  EXPECT_EQ(counts.coarse, 0u);
  EXPECT_GT(counts.fractional, 0u);
  EXPECT_EQ(counts.finest + merged, cells.size());
  EXPECT_GT(counts.along, 100u);
}

TEST(OctreeFormulation, KeepsItsMomentsWhenItSplitsAndAlmostWhenItMerges) {
  const auto f = make({{"epsilon", "0.05"}});
  std::vector<double> x = half_void(*f, shift);
  Moments before = f->moments(x);
  ASSERT_TRUE(f->refine(x));  // nothing is finer than at the start: nothing merges
  Moments after = f->moments(x);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(after[k], before[k], round_off) << moment_names[k];

  x = refine_along(*f, shift);
  const std::size_t fine = f->num_variables();
  Random random(5);
  x = half_void(*f, shift + 9);  // the void grows: what was fine is void or solid now
  for (double& fill : x)
    fill = fill < 0.05 ? uniform(random, 0, 0.05) : fill > 0.95 ? uniform(random, 0.95, 1) : fill;
  before = f->moments(x);
  ASSERT_TRUE(f->refine(x));
  EXPECT_LT(f->num_variables(), fine) << "more merged than split";
  after = f->moments(x);
  // Fills that become one were within epsilon of each other; lengths are below two.
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(after[k], before[k], 4 * 0.05 * torus().interior[S1]) << moment_names[k];
  EXPECT_NEAR(after[S1], before[S1], round_off) << "the mean fill of what merges stays";
}

TEST(OctreeFormulation, ALeafStartsFromItsParentsFill) {
  const auto f = make();
  const std::vector<Cube> parents = f->cells();
  const std::vector<double> fills = half_void(*f, shift);
  std::vector<double> x = fills;
  ASSERT_TRUE(f->refine(x));
  const std::vector<Cube> cells = f->cells();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto same = std::ranges::find(parents, cells[c]);
    const auto from = same != parents.end() ? same : std::ranges::find(parents, cells[c].parent());
    ASSERT_NE(from, parents.end());
    EXPECT_EQ(x[c], fills[static_cast<std::size_t>(from - parents.begin())]);
  }
  f->restart();
  EXPECT_EQ(f->cells(), parents);
}

TEST(OctreeFormulation, RegulariserIsTheSumOfSquaredStepsAcrossFaces) {
  const auto f = make({{"gamma_l", "0.25"}});
  (void)refine_along(*f, shift);
  const SparseForm& form = *f->regulariser();
  const std::size_t n = f->num_variables();
  const double weight = 0.25 / 4096;  // level 6, three further than 3
  EXPECT_EQ(f->count_cells(std::vector<double>(n, 1.0)).weight, weight);
  const auto faces = shared_faces(f->cells(), octree_levels(torus().grid));
  Random random(6);
  for (int trial = 0; trial < 3; ++trial) {
    std::vector<double> x(n), direction(n), gradient(n, 0.0);
    for (double& fill : x) fill = uniform(random, 0, 1);
    for (double& d : direction) d = uniform(random, -1, 1);
    double want = 0, slope = 0, got = 0;
    for (const auto& [a, b] : faces) {
      want += weight / 2 * (x[a] - x[b]) * (x[a] - x[b]);
      slope += weight * (x[a] - x[b]) * (direction[a] - direction[b]);
    }
    EXPECT_NEAR(form.value(x), want, 1e-12 * want) << "so it is never negative";
    form.add_gradient(x, gradient);
    for (std::size_t c = 0; c < n; ++c) got += gradient[c] * direction[c];
    EXPECT_NEAR(got, slope, 1e-12 * want);
  }
  std::vector<double> gradient(n, 0.0);
  form.add_gradient(std::vector<double>(n, 1.0), gradient);
  for (const double g : gradient) EXPECT_EQ(g, 0.0) << "constants cost nothing";
  for (const auto& e : form.entries) EXPECT_GE(e.row, e.column);
  EXPECT_EQ(make({{"gamma_l", "0"}})->regulariser(), nullptr);
}

TEST(OctreeFormulation, RoundsEachLeafAsAWhole) {
  const auto f = make();
  const std::vector<double> x = refine_along(*f, shift);
  const std::vector<Cube> cells = f->cells();
  VoxelSet want(torus(), false);
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (x[c] >= 0.5)
      for (const std::size_t v : voxels_in(cells[c])) want.set(v, true);
  const std::size_t mended = make_well_composed(want);
  const Rounded rounded = f->round(x);
  EXPECT_EQ(rounded.mended, mended);
  for (std::size_t v = 0; v < want.size(); ++v) ASSERT_EQ(rounded.solid.solid(v), want.solid(v)) << v;
}

TEST(OctreeFormulation, TellsItsSettingsAndRefusesUnfitOnes) {
  const std::map<std::string, std::string> defaults = {
      {"gamma_l", "0.001"}, {"epsilon", "0.01"}, {"start_level", "3"}};
  EXPECT_EQ(make()->settings(), defaults);
  for (const SettingTexts& wrong : std::vector<SettingTexts>{{{"gamma_l", "-1"}},
                                                             {{"epsilon", "0.5"}},
                                                             {{"epsilon", "0"}},
                                                             {{"start_level", "7"}},
                                                             {{"start_level", "-1"}},
                                                             {{"gamma", "1"}}})
    expect_refusal([&] { (void)make(wrong); }, "formulation." + wrong.begin()->first, {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
