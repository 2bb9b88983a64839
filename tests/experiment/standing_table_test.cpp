#include "experiment/standing_table.hpp"

#include <gtest/gtest.h>

#include "experiment/data_folder.hpp"
#include "experiment/recorded_runs.hpp"
#include "experiment/voids_table.hpp"

namespace kreisel::core {
namespace {

RecordedRun dinosaur(const std::string& label) {
  RecordedRun run = optimal_run();
  run.run.label = label;
  run.run.asked().body.model = "dino";
  run.run.asked().problem = "stand";
  run.run.asked().formulation = "voxel";
  return run;
}

TEST(StandingTable, GivesHeightAndTiltBesideThePapers) {
  RecordedRun swept = dinosaur("plane sweep"), none = dinosaur("optimum");
  swept.run.asked().solver = "plane-sweep";
  swept.run.asked().settings = {{"problem.target", "inside"}, {"problem.margin", "0"}};
  swept.record->verified_values = {
      {"height_share", 0.5125}, {"off_centroid_mm", 0.25}, {"inside_mm", 0.75}, {"tilt_degrees", 3.5}};
  swept.record->written[S1] = 0.5;
  swept.record->mass_unit_grams = 40;
  none.record.reset();
  const Tables tables = standing_tables({swept, none}, read_published(published_file("spinit_standing")));
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
  RecordedRun run = dinosaur("hand");
  run.run.asked().body.model = "armadillo";
  run.run.asked().problem = "top";
  run.record->voids = 3;
  run.record->islands = 1;
  run.record->cuts = 2;
  run.record->voids_mm3 = 2000;
  run.record->largest_void_mm3 = 1500;
  RecordedRun other = run;
  other.run.label = "shell";
  const Tables tables = voids_tables({run, other}, read_published(published_file("spinit_voids")));
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_TRUE(squeezed_line(text, "hand").ends_with("| 2000 75.00 1 3 2 | 1 3")) << text;
  EXPECT_TRUE(squeezed_line(text, "shell").ends_with("| 2000 75.00 1 3 2 | 5 2")) << text;
}

TEST(VoidsTable, ShowsAPublishedRowThatNoRunIsOfWithThePapersFiguresAlone) {
  const Published paper = read_published(published_file("spinit_voids"));
  RecordedRun stands = dinosaur("");
  const Tables tables = voids_tables({stands}, paper);
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), paper.rows.size()) << text;
  EXPECT_EQ(squeezed_line(text, "-      dancing-couple"),
            "- dancing-couple - top - no run - - | - - - - - | 1 5")
      << text;
  EXPECT_TRUE(squeezed_line(text, "-      dino").ends_with("| 1 1")) << text;
  stands.run.asked().problem = "spin";
  const std::string spins = voids_tables({stands}, paper).blocks[0].sheet.text();
  EXPECT_TRUE(squeezed_line(spins, "-      dino").ends_with("| - -")) << "the paper's stands\n" << spins;
}

}  // namespace
}  // namespace kreisel::core
