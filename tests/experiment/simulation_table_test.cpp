#include "experiment/simulation_table.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"
#include "physics/test_bodies.hpp"

namespace kreisel::core {
namespace {

TEST(SimulationTable, HasAPartThatSpinsWhereItsSolidFalls) {
  RecordedRun run = optimal_run();
  run.run.config.problem = "spin";
  RecordSummary& r = *run.record;
  r.length_mm = 40;
  r.solid = moments_of(1, Vec3(0.05, 0, 0.6), Vec3(0.1, 0.11, 0.105).asDiagonal());
  r.written = moments_of(0.4, 0.5, {0.05, 0.052, 0.07});
  const Tables tables = simulation_tables({run}, {});
  ASSERT_EQ(tables.blocks[0].sheet.rows().size(), 1u);
  const auto& row = tables.blocks[0].sheet.rows()[0];
  EXPECT_EQ(row[1].text, "-") << "the solid's Izz is not the largest";
  // sqrt(M g l / (Izz - Iyy)) rpm, l = 0.5 L = 20 mm; of unequal moments the spectrum's bound is the same.
  EXPECT_EQ(row[4].text, "498");
  EXPECT_EQ(row[5].text, "498");
  EXPECT_EQ(row[7].text, "gliding");
  EXPECT_EQ(row[8].text, "548") << "a tenth more";
  EXPECT_NE(row[9].text, "stable");
  EXPECT_EQ(row[11].text, "stable");
  EXPECT_LT(std::stod(row[12].data), 10);

  // A solid that is nearly as good is told apart at a speed between the two.
  r.solid = moments_of(0.4, 0.5, {0.05, 0.0525, 0.07});
  const auto near = simulation_tables({run}, {}).blocks[0].sheet.rows()[0];
  EXPECT_EQ(near[8].text, "502");
  EXPECT_EQ(near[9].text, "unstable");
  EXPECT_EQ(near[11].text, "stable");

  // Nothing to say of what was not run, or does not spin.
  RecordedRun none = optimal_run();
  none.record.reset();
  EXPECT_TRUE(simulation_tables({none}, {}).blocks[0].sheet.rows().empty());
  run.run.config.problem = "stand";
  EXPECT_TRUE(simulation_tables({run}, {}).blocks[0].sheet.rows().empty());
}

}  // namespace
}  // namespace kreisel::core
