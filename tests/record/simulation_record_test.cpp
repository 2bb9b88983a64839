#include "record/simulation_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "record/record.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace {

class SimulationRecord : public testing::Test {
 protected:
  SimulationRecord() {
    run_.formulation = "quadric";
    run_.grid.resolution = 24;
    run_.body.fineness = 12;
    run_.motion.spin.seconds = 0.5;
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path / "s.h5"; }

  const TemporaryFolder folder_;
  SimulationRun run_;
};

TEST_F(SimulationRecord, HoldsASolveThatIsSetInMotion) {
  run_.body.model = "bird";
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
  const SimulationSummary read = read_simulation(file());
  EXPECT_EQ(read.error, "");
  EXPECT_EQ(read.config, describe(run_));
  EXPECT_EQ(read.termination, "optimal");
  EXPECT_EQ(read.part.above->held, s.part.above->held);
  EXPECT_EQ(read.part.above->eq1, s.part.verdict.values.at("omega_min_rpm"));
  EXPECT_EQ(read.contact, name_of(s.spin.contact));
  EXPECT_EQ(read.rpm, s.spin.rpm);
  EXPECT_EQ(read.part.spectrum, s.part.spin->at_speed.stable() ? "stable" : "unstable");
  EXPECT_EQ(read.part.largest_tilt_degrees, s.part.spin->at_speed.largest_tilt);
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
  run_.body.model = "ellipsoid";
  run_.body.contact = Vec3(15, 19.5, 0);  // beyond x = 21.24 no interior spins: experiments/quadric_2024.toml
  const Simulation s = run_simulation(run_);
  EXPECT_FALSE(s.made);
  EXPECT_EQ(s.termination, "infeasible");
  write_simulation(file(), s);
  const SimulationSummary read = read_simulation(file());
  EXPECT_FALSE(read.made);
  EXPECT_EQ(read.termination, "infeasible");
  EXPECT_FALSE(read.part.above);
}

TEST_F(SimulationRecord, HoldsFailuresAndRefusesWhatDoesNotMove) {
  write_failure(file(), run_, {}, "no such mesh");
  const SimulationSummary read = read_simulation(file());
  EXPECT_EQ(read.error, "no such mesh");
  EXPECT_EQ(read.config, describe(run_));
  run_.problem = "balance";
  expect_refusal([&] { (void)run_simulation(run_); }, "nothing of the problem 'balance' moves",
                 {"spin, top, yoyo, stand, float"});
}

}  // namespace
}  // namespace kreisel::core
