#include "record/simulation_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "record/record.hpp"
#include "record/records_in.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class SimulationRecord : public testing::Test {
 protected:
  SimulationRecord() {
    run_.formulation = "quadric";
    run_.grid.resolution = 24;
    run_.body.fineness = 12;
    run_.wall = parse_wall("1");  // mm; the ellipsoid's part spins
    run_.motion.spin.seconds = 0.5;
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path / "s.h5"; }

  const TemporaryFolder folder_;
  SimulationRun run_;
};

TEST_F(SimulationRecord, HoldsASolveThatIsSetInMotion) {
  const Simulation s = run_simulation(run_);
  ASSERT_TRUE(s.made);
  EXPECT_EQ(s.termination, "optimal");
  ASSERT_TRUE(s.part.above && s.solid.above);
  ASSERT_TRUE(s.part.spin) << "a speed is found where none is given";
  // At a tenth above the part's least, or less; gliding, unless it is stable at no high speed so.
  const bool glides = s.part.above->gliding > 0;
  const double least = glides ? s.part.above->gliding : s.part.above->held;
  EXPECT_EQ(s.spin.contact, glides ? Contact::gliding : Contact::held);
  EXPECT_GT(s.spin.rpm, least);
  EXPECT_LE(s.spin.rpm, 1.1 * least * (1 + 1e-12));

  write_simulation(file(), s);
  // All that people and scripts are told of a simulation is in its record.
  const Record record = read_record(file());
  EXPECT_EQ(record.kind, RecordKind::simulation);
  nlohmann::json kept = record.summary.whole(), told = to_json(s);
  for (nlohmann::json* all : {&kept, &told})
    for (const char* body : {"solid", "part"})
      all->at(body).at("spin").erase("steady_tilt_degrees");  // by way of radians: round-off
  EXPECT_EQ(kept, told);
  EXPECT_EQ(record.config(), describe(run_));
  const Simulation read = read_simulation(file());
  EXPECT_EQ(read.part.above->held, s.part.above->held);
  EXPECT_EQ(read.part.above->eq1, s.part.verdict.values.at("omega_min_rpm"));
  EXPECT_EQ(read.spin.rpm, s.spin.rpm);
}

TEST_F(SimulationRecord, MovesAtTheSpeedThatIsGiven) {
  run_.motion.spin.rpm = 321;
  run_.motion.contact = Contact::held;
  const Simulation s = run_simulation(run_);
  EXPECT_EQ(s.spin.rpm, 321);
  EXPECT_EQ(s.spin.contact, Contact::held);
  EXPECT_NE(run_name(run_), run_name(SimulationRun{run_, {}}));
}

TEST_F(SimulationRecord, SaysThatThereIsNoPart) {
  run_.wall = parse_wall("1.5h");  // at 24 cells it leaves too little
  const Simulation s = run_simulation(run_);
  EXPECT_FALSE(s.made);
  EXPECT_EQ(s.termination, "infeasible");
  write_simulation(file(), s);
  EXPECT_EQ(read_record(file()).summary.whole(), to_json(s));
  EXPECT_FALSE(read_simulation(file()).made);
}

TEST_F(SimulationRecord, HoldsFailuresAndRefusesWhatDoesNotMove) {
  write_failure(file(), run_, {}, "no such mesh");
  const Record failed = read_record(file());
  EXPECT_EQ(failed.error, "no such mesh");
  EXPECT_EQ(failed.config(), describe(run_));
  run_.problem = "balance";
  expect_refusal([&] { (void)run_simulation(run_); }, "there is no motion to simulate for problem 'balance'",
                 {"spin, top, yoyo, stand, float"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
