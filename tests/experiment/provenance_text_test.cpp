#include "table/provenance_text.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace THIS_FILE {

std::string text_of_runs(const std::vector<RecordedRun>& runs) {
  Runs all;
  for (const RecordedRun& run : runs) all.push_back(&run);
  return provenance_text(all);
}

TEST(ProvenanceText, SaysWhereWhatAndWhen) {
  const RecordedRun early = changed_run([](RunResult& r) {
    r.provenance.started = "2026-11-27T23:59:59Z";
    r.provenance.load = 0.04;
  });
  const RecordedRun late = changed_run([](RunResult& r) {
    r.provenance.started = "2026-11-28T00:00:01Z";
    r.provenance.load = 1.96;
    r.samples.resize(3);
  });
  EXPECT_EQ(text_of_runs({early}), "device a device; commit abc1234; 2026-11-27; load 0; 1 sample each");
  EXPECT_EQ(text_of_runs({late, early}),
            "device a device; commit abc1234; 2026-11-27 to 2026-11-28; load 0 to 2; 1 to 3 samples each");
}

TEST(ProvenanceText, CountsTheRunsThatAreNotOnRecord) {
  const RecordedRun missing = missing_run(optimal_result());
  EXPECT_EQ(text_of_runs({missing}), "no records yet");
  EXPECT_EQ(text_of_runs({missing, recorded(optimal_result()), missing}),
            "device a device; commit abc1234; 1 sample each; 1 of 3 runs");
}

TEST(ProvenanceText, KnowsNestings) {
  NestResult nesting;
  nesting.provenance.device = "a nesting's";
  nesting.provenance.commit = "def5678";
  nesting.provenance.started = "2026-11-28T02:00:00Z";
  nesting.provenance.load = std::numeric_limits<double>::quiet_NaN();
  RecordedRun run;
  run.record = Record{"nest.h5", RecordKind::nesting, "", to_json(nesting)};
  EXPECT_EQ(text_of_runs({run}), "device a nesting's; commit def5678; 2026-11-28");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
