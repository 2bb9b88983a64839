#include "experiment/simulation_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kreisel::core {
namespace {

RecordedRun simulated_run(const std::string& model) {
  RecordedRun run;
  run.run.run = SimulationRun();
  run.run.asked().body.model = model;
  SimulationSummary& s = run.simulation.emplace();
  s.contact = "gliding";
  s.rpm = 548.2;
  s.solid = {StableAbove{std::nan(""), std::nan(""), std::nan("")}, "no steady spin", 60, 0.25};
  s.part = {StableAbove{498.1, 498.2, 510.4}, "stable", 1.234, {}};
  return run;
}

TEST(SimulationTable, SetsOutWhatIsOnRecord) {
  RecordedRun still = simulated_run("bird"), none = simulated_run("duck"), failed = simulated_run("bear"),
              not_run = simulated_run("heart");
  still.simulation->contact.clear();
  none.simulation->made = false;
  none.simulation->termination = "infeasible";
  none.simulation->solid = none.simulation->part = {};
  failed.simulation->error = "no such thing";
  failed.simulation->solid = failed.simulation->part = {};
  not_run.simulation.reset();
  const Tables tables = simulation_tables({simulated_run("ellipsoid"), still, none, failed, not_run}, {});
  const auto& rows = tables.blocks[0].sheet.rows();
  ASSERT_EQ(rows.size(), 2u) << "nothing to say of what was not run, failed, or made no part";
  const auto texts = [](const auto& row) {
    std::string all;
    for (const Cell& cell : row) all += cell.text + "|";
    return all;
  };
  EXPECT_EQ(texts(rows[0]),
            "ellipsoid|-|-|-|498|498|510|gliding|548|no steady spin|falls in 0.25 s|stable|1.23|");
  EXPECT_EQ(texts(rows[1]), "bird|-|-|-|498|498|510|-|-|-|-|-|-|");
  const std::string& notes = tables.blocks[0].notes;
  EXPECT_NE(notes.find("duck 64 spin simulation: infeasible, no part\n"), std::string::npos) << notes;
  EXPECT_NE(notes.find("bear 64 spin simulation: error - no such thing\n"), std::string::npos) << notes;
  EXPECT_NE(notes.find("heart 64 spin simulation: not run\n"), std::string::npos) << notes;
}

}  // namespace
}  // namespace kreisel::core
