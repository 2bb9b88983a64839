#include "experiment/certificate_table.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace {

RecordedRun certified_run() {
  RecordedRun run = optimal_run();
  RecordSummary& r = *run.record;
  r.domain = "columns";
  r.rays = 650;
  r.bound = 0.7996;
  r.gap = 5e-4;
  r.certificate_kind = "spin";
  r.certificate_boxes = 7;
  r.certificate_seconds = 0.125;
  return run;
}

TEST(CertificateTable, SetsTheBoundBesideTheObjective) {
  const Tables tables = certificate_tables({certified_run()}, {});
  EXPECT_EQ(squeezed_line(to_text(tables), "ellipsoid"),
            "ellipsoid 40x26x26 spin rayrep columns 650 optimal | 0.500 0.8 | spin 0.7996 0.05 7 0.125");
  EXPECT_NE(to_csv(tables).find(",spin,0.7996,0.05,7,0.125\n"), std::string::npos) << to_csv(tables);
}

TEST(CertificateTable, HasDashesForWhatWasNotCertifiedOrDidNotRun) {
  RecordedRun plain = optimal_run(), missing = certified_run();
  plain.record->domain = "exact";
  plain.run.asked().problem = "stand";
  missing.record.reset();
  const std::string text = to_text(certificate_tables({plain, missing}, {}));
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  stand"),
            "ellipsoid 40x26x26 stand rayrep exact 0 optimal | 0.500 0.8 | - - - - -")
      << text;
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  spin"),
            "ellipsoid 40x26x26 spin rayrep - - not run | - - | - - - - -")
      << text;
}

}  // namespace
}  // namespace kreisel::core
