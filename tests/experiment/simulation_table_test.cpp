#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"
#include "physics/test_bodies.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {
namespace THIS_FILE {

SimulatedBody simulated(const Moments& moments, const SpinCheckOptions& options, double length_mm) {
  SimulatedBody body;
  body.moments = moments;
  body.verdict.values["omega_min_rpm"] = 500;
  const auto above = [&](Contact contact) {
    return stable_above(stable_rpm(moments, length_mm, contact)).value_or(std::nan(""));
  };
  body.above = StableAbove{500, above(Contact::gliding), above(Contact::held)};
  body.spin = check_spin(moments, length_mm, options);
  return body;
}

TEST(SimulationTable, SetsAPartThatSpinsBesideItsSolidThatFalls) {
  Simulation s;
  s.config.problem = "spin";
  s.body_name = "ellipsoid";
  s.length_mm = 40;
  s.spin.rpm = 548;
  s.solid = simulated(moments_of(1, Vec3(0.05, 0, 0.6), Vec3(0.1, 0.11, 0.105).asDiagonal()), s.spin, 40);
  s.part = simulated(moments_of(0.4, 0.5, {0.05, 0.052, 0.07}), s.spin, 40);
  RecordedRun run;
  run.record = Record{"simulation.h5", RecordKind::simulation, "", to_json(s)};
  const Tables tables = tables_by("simulation", {run, RecordedRun{}});
  ASSERT_EQ(tables.blocks[0].sheet.rows().size(), 1u) << "nothing to say of what was not run";
  const auto& row = tables.blocks[0].sheet.rows()[0];
  // sqrt(M g l / (Izz - Iyy)) rpm, l = 0.5 L = 20 mm; of unequal moments the spectrum's bound is the same.
  EXPECT_EQ(row[5].text, "498");
  EXPECT_EQ(row[7].text, "gliding");
  EXPECT_EQ(row[8].text, "548");
  EXPECT_NE(row[9].text, "stable");
  EXPECT_EQ(row[11].text, "stable");
  EXPECT_LT(std::stod(row[12].data), 10);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
