#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunResult certified_result() {
  RunResult r = optimal_result();
  r.domain = "columns";
  r.rays = 650;
  Certificate& c = r.certificate.emplace();
  c.kind = Certificate::Kind::spin;
  c.bound = 0.7996;
  c.searches = 7;
  c.seconds = 0.125;
  return r;
}

TEST(CertificateTable, SetsTheBoundBesideTheObjective) {
  const Tables tables = tables_by("certificate", {recorded(certified_result())});
  EXPECT_EQ(squeezed_line(to_text(tables), "ellipsoid"),
            "ellipsoid 40x26x26 spin rayrep columns 650 optimal | 0.500 0.8 | spin 0.7996 0.05 7 0.125");
  EXPECT_NE(to_csv(tables).find(",spin,0.7996,0.05"), std::string::npos) << to_csv(tables);
}

TEST(CertificateTable, HasDashesForWhatWasNotCertifiedOrDidNotRun) {
  const RecordedRun plain = changed_run([](RunResult& r) {
    r.domain = "exact";
    r.config.problem = "stand";
  });
  const std::string text = to_text(tables_by("certificate", {plain, missing_run(certified_result())}));
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  stand"),
            "ellipsoid 40x26x26 stand rayrep exact 0 optimal | 0.500 0.8 | - - - - -")
      << text;
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  spin"),
            "ellipsoid 40x26x26 spin rayrep - - not run | - - | - - - - -")
      << text;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
