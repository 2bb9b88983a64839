#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunResult dinosaur() {
  RunResult r = optimal_result();
  r.config.body.model = "dino";
  r.config.problem = "stand";
  r.config.formulation = "voxel";
  return r;
}

TEST(StandingTable, GivesHeightAndTiltBesideThePapers) {
  RunResult swept = dinosaur();
  swept.config.solver = "plane-sweep";
  swept.config.settings = {{"problem.target", "inside"}, {"problem.margin", "0"}};
  swept.verified.verdict.values = {
      {"height_share", 0.5125}, {"off_centroid_mm", 0.25}, {"inside_mm", 0.75}, {"tilt_degrees", 3.5}};
  swept.verified.moments[S1] = 0.5;
  swept.mass_unit_grams = 40;
  const Tables tables =
      tables_by("standing", {recorded(swept, "plane sweep"), missing_run(dinosaur(), "optimum")},
                read_published(published_file("spinit_standing")));
  ASSERT_EQ(tables.blocks.size(), 1u);
  EXPECT_EQ(tables.blocks[0].heading, "dino 40x26x26");
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_EQ(squeezed_line(text, "plane sweep"),
            "plane sweep voxel plane-sweep inside, 0 mm optimal 0.500 | 51.2 0.250 0.750 | 3.50 | 20.00 yes")
      << text;
  EXPECT_EQ(squeezed_line(text, "optimum"), "optimum voxel ipopt centre not run - | - - - | - | - -") << text;
  EXPECT_EQ(squeezed_line(text, "paper"), "paper - plane-sweep - - - | 56 - - | 1 | - -") << text;
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), 4u);
}

TEST(VoidsTable, CountsVoidsAndCutsBesideThePapersOfThatModelAndLabel) {
  RunResult r = dinosaur();
  r.config.body.model = "armadillo";
  r.config.problem = "top";
  r.voids.pieces = {1500, 400, 100};
  r.voids.islands = {3};
  r.voids.cuts.resize(2);
  const Tables tables = tables_by("voids", {recorded(r, "hand"), recorded(r, "shell")},
                                  read_published(published_file("spinit_voids")));
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_TRUE(squeezed_line(text, "hand").ends_with("| 2000 75.00 1 3 2 | 1 3")) << text;
  EXPECT_TRUE(squeezed_line(text, "shell").ends_with("| 2000 75.00 1 3 2 | 5 2")) << text;
}

TEST(VoidsTable, ShowsAPublishedRowThatNoRunIsOfWithThePapersFiguresAlone) {
  const Published paper = read_published(published_file("spinit_voids"));
  RunResult stands = dinosaur();
  const Tables tables = tables_by("voids", {recorded(stands)}, paper);
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), paper.rows.size()) << text;
  EXPECT_EQ(squeezed_line(text, "-      dancing-couple"),
            "- dancing-couple - top - no run - - | - - - - - | 1 5")
      << text;
  EXPECT_TRUE(squeezed_line(text, "-      dino").ends_with("| 1 1")) << text;
  stands.config.problem = "spin";
  const std::string spins = tables_by("voids", {recorded(stands)}, paper).blocks[0].sheet.text();
  EXPECT_TRUE(squeezed_line(spins, "-      dino").ends_with("| - -")) << "the paper's stands\n" << spins;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
