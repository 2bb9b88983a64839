// infill_test.cpp - sparse infill: what is asked for, what it weighs, and that nobody assumes it.
#include "print/slice/infill.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>

#include "installed.hpp"
#include "mesh/shapes.hpp"
#include "print/slice/infill_density.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(InfillText, IsAShareAndAPattern) {
  EXPECT_EQ(parse_infill("15%"), (Infill{15, "gyroid"}));
  EXPECT_EQ(parse_infill("12.5%:grid"), (Infill{12.5, "grid"}));
  EXPECT_EQ(parse_infill(to_string(Infill{7, "cubic"})), (Infill{7, "cubic"}));
  for (const char* share : {"0%", "100%", "-3%", "15", "15%%", "nan%", ""})
    expect_refusal([&] { (void)parse_infill(share); }, "--infill ", {"less than 100 %"});
  expect_refusal([] { (void)parse_infill("15%:girod"); }, "--infill 15%:girod: no pattern girod", {"gyroid"});
  expect_refusal([] { (void)parse_infill("15%:"); }, "--infill 15%:: no pattern ", {"gyroid"});
  expect_refusal([] { (void)parse_infill("15%:lightning"); }, "--infill 15%:lightning: lightning is denser",
                 {"gyroid"});
  expect_refusal([] { (void)parse_dialect("cura"); }, "--project cura, ", {"orca"});
}

TEST(InfillText, IsWhatEachSlicerCallsIt) {
  const Filled part{box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({2, 2, 2}, {8, 8, 8})};
  using Setting = std::pair<std::string, std::string>;
  const auto has = [](const threemf::Volume& volume, const Setting& setting) {
    return std::ranges::find(volume.settings, setting) != volume.settings.end();
  };
  const auto prusa = project_of(part, {20, "stars"}, threemf::Dialect::prusa, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(has(prusa.volumes[0], {"fill_density", "100%"}));
  for (const Setting& setting : {Setting{"fill_density", "20%"}, Setting{"fill_pattern", "stars"},
                                 Setting{"perimeters", "0"}, Setting{"solid_infill_below_area", "0"}})
    EXPECT_TRUE(has(prusa.volumes[1], setting)) << setting.first;
  const auto orca = project_of(part, {20, "stars"}, threemf::Dialect::orca, Eigen::Isometry3d::Identity());
  for (const Setting& setting :
       {Setting{"sparse_infill_density", "20%"}, Setting{"sparse_infill_pattern", "tri-hexagon"},
        Setting{"wall_loops", "0"}, Setting{"minimum_sparse_infill_area", "0"}})
    EXPECT_TRUE(has(orca.volumes[1], setting)) << setting.first;
}

TEST(InfillText, NeedsASlicerThatOpensProjects) {
  if (!installed("CuraEngine")) GTEST_SKIP() << "cura-engine is not here";
  SliceSpec spec{"cura-engine", {}};
  spec.infill = Infill{};
  expect_refusal([&] { (void)MeshSlicer(spec); }, "--infill by cura-engine, ", {"prusa-slicer"});
}

/// A cache of the test's own.
class MeasuredInfill : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const char* before = std::getenv("KREISEL_CACHE_DIR")) before_ = before;
    ::setenv("KREISEL_CACHE_DIR", folder_.path.c_str(), 1);
  }
  void TearDown() override {
    if (before_)
      ::setenv("KREISEL_CACHE_DIR", before_->c_str(), 1);
    else
      ::unsetenv("KREISEL_CACHE_DIR");
  }
  [[nodiscard]] InfillDensity measured(const Infill& infill, const std::string& profile = "") const {
    SliceSpec spec{"prusa-slicer", profile};
    spec.infill = infill;
    return measure_infill(spec, {});
  }
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path / "infill"), {});
  }

  TemporaryFolder folder_;
  std::optional<std::string> before_;
};

TEST_F(MeasuredInfill, IsThatOfABlockThatWasNoTestBlock) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const InfillDensity density = measured({15, "gyroid"});
  ASSERT_EQ(density.blocks.size(), 3u);
  EXPECT_FALSE(density.remembered);
  // Far from its boundary what the slicer was asked for, within a pitch of its lines.
  EXPECT_NEAR(density.bulk, 0.15, 0.02);
  EXPECT_GT(density.skin, 0);
  // A plate of another shape: full, and with a core. More of its boundary is level than a cube's, which
  // holds less than what stands upright: two per cent of what is full.
  SliceSpec spec{"prusa-slicer", {}};
  spec.infill = Infill{15, "gyroid"};
  const MeshSlicer slice(spec);
  const Vec3 core(50, 36, 14);
  Filled plate{box_mesh({0, 0, 0}, core + Vec3(8, 8, 8)), {}};
  const double full = slice(plate, Vec3::UnitZ(), 1, {}).print.part_volume();
  plate.sparse = box_mesh({4, 4, 4}, core + Vec3(4, 4, 4));
  const double cored = slice(plate, Vec3::UnitZ(), 1, {}).print.part_volume();
  const double volume = core.prod();
  const double surface = 2 * (core[0] * core[1] + core[1] * core[2] + core[2] * core[0]);
  EXPECT_NEAR(density.share(volume, surface), 1 - (full - cored) / volume, 0.025);
}

TEST_F(MeasuredInfill, IsRememberedByProfileAndPattern) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const InfillDensity first = measured({30, "grid"}), again = measured({30, "grid"});
  EXPECT_TRUE(again.remembered);
  EXPECT_EQ(again.bulk, first.bulk);
  EXPECT_EQ(files(), 1);
  const std::string coarse =
      folder_
          .write("p/coarse.ini",
                 "layer_height = 0.3\nfirst_layer_height = 0.3\nbed_shape = 0x0,200x0,200x200,0x200\n")
          .string();
  EXPECT_FALSE(measured({30, "grid"}, coarse).remembered);
  EXPECT_FALSE(measured({20, "grid"}).remembered);
  EXPECT_EQ(files(), 3);
  // What is not whole is measured again.
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path / "infill"))
    std::filesystem::resize_file(entry.path(), std::filesystem::file_size(entry.path()) - 3);
  EXPECT_FALSE(measured({20, "grid"}).remembered);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
