#include "table/inertia_table.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "experiment/recorded_runs.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A box of 2 x 4 x 6 body lengths about a centre off the origin, of mass 48 body masses.
Moments box() { return box_moments({1, 2, 3}, {2, 4, 6}); }

RunResult box_result(const Moments& optimum) {
  RunResult r = optimal_result();
  r.frame.length = r.length_mm = 10;  // 1 cm, so that M L^2 is mass_unit g cm^2
  r.mass_unit_grams = 3;
  r.solid = box();
  r.outcome.moments = optimum;
  r.verified.verdict.text = "spins";
  return r;
}

RecordedRun box_run(const Moments& optimum) { return recorded(box_result(optimum)); }

TEST(InertiaTable, GivesABoxItsInertiaInGramsAndCentimetres) {
  const Tables tables = inertia_tables({box_run(box())}, {});
  ASSERT_EQ(tables.blocks.size(), 1u);
  // m/12 (b^2 + c^2) with m = 48 * 3 g: 12 * (16+36, 4+36, 4+16). z is its smallest moment.
  const std::string numbers =
      "624.00 480.00 240.00 0.00 0.00 0.00 | 2.6000 2.0000 1.0000 0.0000 0.0000 0.0000 | 240.00 480.00 "
      "624.00 | "
      "0.000 no";
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_EQ(squeezed_line(text, "solid"), "solid | " + numbers);
  EXPECT_EQ(squeezed_line(text, "optimum"), "optimum | " + numbers);
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), 2u) << "a part that was not integrated has no row";
  EXPECT_NE(tables.blocks[0].notes.find("verified: spins\n"), std::string::npos);
}

TEST(InertiaTable, SeesATiltAndWhichMomentIsTheLargest) {
  // A flat box, its short side along z, tilted by 5 degrees about x: z is nearest to the largest moment.
  const Eigen::Matrix3d tilt(Eigen::AngleAxisd(5 * std::numbers::pi / 180, Eigen::Vector3d::UnitX()));
  const Moments flat = transformed(box_moments({0, 0, 0}, {4, 6, 2}), tilt, {0, 0, 1});
  const std::string text = inertia_tables({box_run(flat)}, {}).blocks[0].sheet.text();
  EXPECT_TRUE(squeezed_line(text, "optimum").ends_with("| 480.00 240.00 624.00 | 5.000 yes") ||
              squeezed_line(text, "optimum").ends_with("| 240.00 480.00 624.00 | 5.000 yes"))
      << text;
}

TEST(InertiaTable, PutsThePapersBirdBesideOursAsPrintedAndRelativeToItsOwnIzz) {
  RunResult result = box_result(box());
  result.config.body.model = "bird";
  const RecordedRun run = recorded(result);
  const auto printed = read_published(published_file("rayrep_bird"));
  const std::string text = inertia_tables({run}, printed).blocks[0].sheet.text();
  EXPECT_TRUE(
      squeezed_line(text, "paper, before")
          .starts_with("paper, before | 110.00 138.50 143.20 -10.70 -1.90 19.50 | 0.7682 0.9672 1.0000 "
                       "-0.0747 -0.0133 0.1362 |"))
      << text;
  // 98.4 / 143.2; after hollowing z is principal and the largest: the block of x and y has the two others,
  // (64 + 78.7) / 2 -+ sqrt(7.35^2 + 7.9^2).
  EXPECT_EQ(squeezed_line(text, "paper, after"),
            "paper, after | 64.00 78.70 98.40 -7.90 0.00 0.00 | 0.4469 0.5496 0.6872 -0.0552 0.0000 0.0000 | "
            "60.56 82.14 98.40 | 0.000 yes");
}

TEST(InertiaTable, ShowsThePaperAloneBeforeTheRun) {
  RunResult result = optimal_result();
  result.config.body.model = "bird";
  const Tables tables = inertia_tables({missing_run(result)}, read_published(published_file("rayrep_bird")));
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), 2u);
  EXPECT_EQ(tables.blocks[0].notes, "not run\n");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
