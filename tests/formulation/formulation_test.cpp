#include "formulation/formulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "domain/test_bodies.hpp"
#include "error.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Two intervals in many columns, rounding and a spacing that is no power of two.
const Columns& torus() {
  static const Columns domain = [] {
    GridSpec spec;
    spec.resolution = 24;
    return make_columns(body_of(moved(upright_torus_mesh(0.7, 0.28, 48, 24), Eigen::Matrix3d::Identity(),
                                      Vec3(0.05, -0.02, 0.98))),
                        spec, {1, Wall::cells});
  }();
  return domain;
}

struct Kind {
  std::string formulation;
  SettingTexts settings;
  bool single;
  Filling filling = Filling::segment;
};

std::string name_of(const Kind& kind) {
  std::string name = kind.formulation;
  for (const auto& [key, value] : kind.settings) name += "_" + value;
  if (kind.filling == Filling::from_below) name += "_from_below";
  if (kind.filling == Filling::either_end) name += "_either_end";
  return name + (kind.single ? "_single" : "");
}

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << name_of(kind); }

class FormulationOn : public testing::TestWithParam<Kind> {
 protected:
  device::Device& device() { return GetParam().single ? single_device() : test_device(); }
  std::unique_ptr<Formulation> make() {
    return make_formulation(GetParam().formulation, torus(), {GetParam().filling}, GetParam().settings,
                            device());
  }
  /// Two variables a ray that may meet anywhere.
  [[nodiscard]] bool ordered() const {
    if (GetParam().formulation == "voxel" || from_below()) return false;
    const auto found = GetParam().settings.find("bounds");
    if (found != GetParam().settings.end()) return found->second == "ordered";
    return GetParam().filling == Filling::either_end;
  }
  [[nodiscard]] bool from_below() const { return GetParam().filling == Filling::from_below; }
  /// A ray's z0 and z1 are variables, interleaved.
  [[nodiscard]] bool two_ends() const { return GetParam().formulation == "rayrep" && !from_below(); }
  [[nodiscard]] double unit() const {
    const auto found = GetParam().settings.find("unit");
    return found != GetParam().settings.end() && found->second == "body" ? 1 : torus().grid.h;
  }

  /// Random variables within bounds and the formulation's own rows.
  std::vector<double> random_x(const Formulation& f, Random& random) const {
    std::vector<double> x(f.num_variables());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = uniform(random, f.bounds().lower[i], f.bounds().upper[i]);
    if (ordered())
      for (std::size_t i = 0; i < x.size(); i += 2)
        if (x[i] > x[i + 1]) std::swap(x[i], x[i + 1]);
    return x;
  }

  /// What moments() may be off by: terms of a voxel or ray below |s| of a solid as large, in numbers of order
  /// one; 16 roundings a term and a compensated sum, or sums of at most 2^7 in a chain.
  double tolerance() { return (device().single() ? 32 : 256) * device().unit_roundoff() * 4; }
};

TEST_P(FormulationOn, AllSolidHasTheMomentsOfTheInterior) {
  auto f = make();
  std::vector<double> x = f->bounds().upper;
  if (two_ends())  // each ray from its lowest to its highest point
    for (std::size_t i = 0; i < x.size(); i += 2) x[i] = f->bounds().lower[i];
  const Moments got = f->moments(x);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(got[k], torus().interior[k], tolerance()) << moment_names[k];
  const Rounded rounded = f->round(x);
  EXPECT_EQ(rounded.solid.count_solid(), torus().interior_voxels);
  EXPECT_EQ(rounded.mended, 0u);
}

TEST_P(FormulationOn, AllVoidHasNoMoments) {
  auto f = make();
  std::vector<double> x = f->bounds().lower;
  for (std::size_t i = 0; two_ends() && i < x.size(); i += 2)
    x[i] = x[i + 1];  // the lowest z1, which every kind of bounds allows z0 as well
  EXPECT_EQ(f->moments(x), Moments(Moments::Zero()));
}

TEST_P(FormulationOn, StartsAtItsBoundsOrHalfWay) {
  const auto f = make();
  EXPECT_EQ(f->start(Start::lower), f->bounds().lower);
  EXPECT_EQ(f->start(Start::upper), f->bounds().upper);
  const auto middle = f->start(Start::middle);
  ASSERT_EQ(middle.size(), f->num_variables());
  for (std::size_t i = 0; i < middle.size(); ++i) {
    // Ordered ends start at the quarter points: half way they would meet and leave no material.
    const double share = !ordered() ? 0.5 : i % 2 == 0 ? 0.25 : 0.75;
    EXPECT_EQ(middle[i], (1 - share) * f->bounds().lower[i] + share * f->bounds().upper[i]);
    EXPECT_LT(f->bounds().lower[i], f->bounds().upper[i]);
  }
}

TEST_P(FormulationOn, KeepsSegmentsInOrderByBoundsOrByRows) {
  const auto f = make();
  const SparseRows rows = f->own_constraints();
  if (!ordered()) {
    EXPECT_TRUE(rows.entries.empty() && rows.lower.empty() && rows.upper.empty());
    if (two_ends()) {
      for (std::size_t i = 0; i < f->num_variables(); i += 2)
        EXPECT_EQ(f->bounds().upper[i], f->bounds().lower[i + 1]) << "z0 <= middle <= z1";
    }
    return;
  }
  ASSERT_EQ(rows.lower.size(), torus().intervals.size());
  Random random(51);
  const auto x = random_x(*f, random);
  std::vector<double> value(rows.lower.size(), 0.0);
  for (const SparseRows::Entry& e : rows.entries)
    value[static_cast<std::size_t>(e.row)] += e.value * x[static_cast<std::size_t>(e.column)];
  for (std::size_t i = 0; i < value.size(); ++i) {
    EXPECT_EQ(value[i], x[2 * i + 1] - x[2 * i]);
    EXPECT_EQ(rows.lower[i], 0);
    EXPECT_TRUE(std::isinf(rows.upper[i]));
  }
}

TEST_P(FormulationOn, PullBackPredictsSmallChangesOfTheMoments) {
  auto f = make();
  Random random(52);
  const auto x = random_x(*f, random);
  const std::size_t n = f->num_variables();
  std::vector<Moments> units;
  for (int k = 0; k < 10; ++k) units.push_back(Moments::Unit(k));
  std::vector<double> jacobian(10 * n);
  f->pull_back(x, units, jacobian);
  // Along a direction of one cell (or one full fill) at most, s is a cubic: with central differences of step
  // t only t^2 / 6 of its third derivative, below one cell cubed of the volume, is missing.
  const double t = f->moments_are_linear() ? 0.25 : std::cbrt(device().unit_roundoff());
  const double truncation = f->moments_are_linear() ? 0 : t * t;
  std::vector<double> direction(n), up = x, down = x;
  for (std::size_t i = 0; i < n; ++i) {
    direction[i] =
        uniform(random, -1, 1) * (f->name() == "voxel" || f->bounds().upper[i] > 2 ? 1 : torus().grid.h);
    up[i] += t * direction[i];
    down[i] -= t * direction[i];
  }
  const Moments want = (f->moments(up) - f->moments(down)) / (2 * t);
  for (int k = 0; k < 10; ++k) {
    double got = 0;
    for (std::size_t i = 0; i < n; ++i) got += jacobian[static_cast<std::size_t>(k) * n + i] * direction[i];
    EXPECT_NEAR(got, want[k], tolerance() / t + truncation * torus().grid.h) << moment_names[k];
  }
}

TEST_P(FormulationOn, CurvatureIsTheChangeOfThePullBack) {
  auto f = make();
  Random random(53);
  const auto x = random_x(*f, random);
  const std::size_t n = f->num_variables();
  Moments w;
  for (int k = 0; k < 10; ++k) w[k] = uniform(random, -1, 1);
  std::vector<double> got(n, 7.0), up(n), down(n);
  f->curvature(x, w, got);
  if (f->moments_are_linear()) {
    for (const double c : got) EXPECT_EQ(c, 0.0);
    return;
  }
  auto above = x, below = x;
  for (std::size_t i = 0; i < n; ++i) {
    const double step = (f->bounds().upper[i] - f->bounds().lower[i]) / 2;  // exact for a quadratic
    above[i] += step;
    below[i] -= step;
  }
  f->pull_back(above, {&w, 1}, up);
  f->pull_back(below, {&w, 1}, down);
  double largest = 0;
  for (const double g : up) largest = std::max(largest, std::abs(g));
  for (std::size_t i = 0; i < n; ++i) {
    const double width = above[i] - below[i];
    // 32 roundings of ten terms whose sum is at most ten times the largest derivative.
    EXPECT_NEAR(got[i], (up[i] - down[i]) / width, 320 * device().unit_roundoff() * largest / width) << i;
  }
}

TEST_P(FormulationOn, AFillOfWholeVoxelsRoundsToItself) {
  auto f = make();
  Random random(54);
  const Columns& domain = torus();
  VoxelSet wanted(domain, false);
  std::vector<double> x(f->num_variables());
  for (std::size_t i = 0; i < domain.intervals.size(); ++i) {
    const Interval& run = domain.intervals[i];
    const int middle = (run.k0 + run.k1) / 2;  // z0 <= middle <= z1 under either kind of bounds
    const int from = from_below() ? run.k0 : std::uniform_int_distribution<int>(run.k0, middle)(random);
    const int to = std::uniform_int_distribution<int>((run.k0 + run.k1 + 1) / 2, run.k1)(random);
    for (int k = from; k < to; ++k) wanted.set(wanted.first(i) + static_cast<std::size_t>(k - run.k0), true);
    if (f->name() == "voxel") continue;
    if (two_ends()) x[2 * i] = domain.grid.face(2, from) / unit();
    x[two_ends() ? 2 * i + 1 : i] = domain.grid.face(2, to) / unit();
  }
  if (f->name() == "voxel")
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = wanted.solid(v) ? 1 : 0;

  const Moments exact = moments(wanted), got = f->moments(x);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(got[k], exact[k], tolerance()) << moment_names[k];
  const Rounded rounded = f->round(x);
  std::size_t added = 0;
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    EXPECT_TRUE(rounded.solid.solid(v) || !wanted.solid(v)) << "voxel " << v << " was lost";
    added += rounded.solid.solid(v) && !wanted.solid(v);
  }
  EXPECT_EQ(added, rounded.mended) << "only mending adds voxels";
  VoxelSet mended = wanted;
  EXPECT_EQ(make_well_composed(mended), rounded.mended);
}

TEST_P(FormulationOn, RoundsToTheNearestVoxelFace) {
  auto f = make();
  const Columns& domain = torus();
  std::vector<double> x(f->num_variables(), 0.49);
  if (f->name() == "rayrep") {
    const double h = domain.grid.h;
    for (std::size_t i = 0; i < domain.intervals.size(); ++i) {
      // Just under half a cell inside the interval's own ends: nothing is lost.
      if (two_ends()) x[2 * i] = (domain.grid.face(2, domain.intervals[i].k0) + 0.49 * h) / unit();
      x[two_ends() ? 2 * i + 1 : i] = (domain.grid.face(2, domain.intervals[i].k1) - 0.49 * h) / unit();
    }
    EXPECT_EQ(f->round(x).solid.count_solid(), domain.interior_voxels);
    if (!from_below()) return;
    // Just under half a cell of material: none is left, and nothing is mended.
    for (std::size_t i = 0; i < domain.intervals.size(); ++i)
      x[i] = (domain.grid.face(2, domain.intervals[i].k0) + 0.49 * h) / unit();
    EXPECT_EQ(f->round(x).solid.count_solid(), 0u);
  } else {
    EXPECT_EQ(f->round(x).solid.count_solid(), 0u);
    std::ranges::fill(x, 0.5);
    EXPECT_EQ(f->round(x).solid.count_solid(), domain.interior_voxels);
  }
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const bool single : {false, true}) {
    all.push_back({"voxel", {}, single});
    for (const char* bounds : {"midpoint", "ordered"})
      for (const char* unit : {"cell", "body"})
        all.push_back({"rayrep", {{"bounds", bounds}, {"unit", unit}}, single});
    for (const char* unit : {"cell", "body"})
      all.push_back({"rayrep", {{"unit", unit}}, single, Filling::from_below});
    all.push_back({"rayrep", {{"bounds", "midpoint"}}, single, Filling::from_below});  // says nothing here
    all.push_back({"rayrep", {}, single, Filling::either_end});
    all.push_back({"rayrep", {{"bounds", "midpoint"}}, single, Filling::either_end});
    all.push_back({"voxel", {}, single, Filling::from_below});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Kinds, FormulationOn, testing::ValuesIn(kinds()),
                         [](const auto& p) { return name_of(p.param); });

TEST(MakeFormulation, DefaultsToMidpointsInCells) {
  const auto plain = make_formulation("rayrep", torus(), {}, {}, test_device());
  const auto spelt =
      make_formulation("rayrep", torus(), {}, {{"bounds", "midpoint"}, {"unit", "cell"}}, test_device());
  EXPECT_EQ(plain->bounds().lower, spelt->bounds().lower);
  EXPECT_EQ(plain->bounds().upper, spelt->bounds().upper);
  EXPECT_EQ(plain->num_variables(), 2 * torus().intervals.size());
  EXPECT_EQ(plain->name(), "rayrep");
}

TEST(MakeFormulation, RaysFilledFromBelowHaveOneVariableEach) {
  const auto f = make_formulation("rayrep", torus(), {Filling::from_below}, {}, test_device());
  ASSERT_EQ(f->num_variables(), torus().intervals.size());
  const double h = torus().grid.h;
  for (std::size_t i = 0; i < torus().intervals.size(); ++i) {
    EXPECT_EQ(f->bounds().lower[i], torus().grid.face(2, torus().intervals[i].k0) / h);
    EXPECT_EQ(f->bounds().upper[i], torus().grid.face(2, torus().intervals[i].k1) / h);
  }
}

void refuses(const std::string& name, const SettingTexts& settings, const std::string& part) {
  try {
    (void)make_formulation(name, torus(), {}, settings, test_device());
    FAIL() << "accepted; expected: " << part;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(MakeFormulation, RefusesUnknownNamesAndUnfitSettings) {
  refuses("vocksel", {}, "formulation 'vocksel' is unknown; expected one of: voxel, rayrep");
  refuses("voxel", {{"unit", "cell"}},
          "formulation.unit = cell; voxel has no setting of that name; expected none");
  refuses("rayrep", {{"bounds", "both"}}, "formulation.bounds = 'both'; expected midpoint or ordered");
  refuses("rayrep", {{"units", "cell"}},
          "formulation.units = cell; rayrep has no setting of that name (did you mean unit?)");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
