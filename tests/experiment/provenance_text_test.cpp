#include "experiment/provenance_text.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace {

TEST(ProvenanceText, SaysWhereWhatAndWhen) {
  RecordedRun early = optimal_run(), late = optimal_run();
  early.record->started = "2026-11-27T23:59:59Z";
  early.record->load = 0.04;
  late.record->started = "2026-11-28T00:00:01Z";
  late.record->load = 1.96;
  late.record->samples.resize(3);
  EXPECT_EQ(provenance_text({early}), "device a device; commit abc1234; 2026-11-27; load 0; 1 sample each");
  EXPECT_EQ(provenance_text({late, early}),
            "device a device; commit abc1234; 2026-11-27 to 2026-11-28; load 0 to 2; 1 to 3 samples each");
}

TEST(ProvenanceText, CountsTheRunsThatAreNotOnRecord) {
  RecordedRun missing = optimal_run();
  missing.record.reset();
  EXPECT_EQ(provenance_text({missing}), "no records yet");
  EXPECT_EQ(provenance_text({missing, optimal_run(), missing}),
            "device a device; commit abc1234; 1 sample each; 1 of 3 runs");
}

TEST(ProvenanceText, KnowsMapsAndNestings) {
  RecordedRun map, nest;
  map.map.emplace().device = "a map's";
  map.map->started = "2026-11-28T01:00:00Z";
  map.map->commit = "abc1234";
  nest.nest.emplace().device = "a nesting's";
  nest.nest->commit = "def5678";
  nest.nest->started = "2026-11-28T02:00:00Z";
  EXPECT_EQ(provenance_text({map, nest}), "device a map's, a nesting's; commit abc1234, def5678; 2026-11-28");
}

}  // namespace
}  // namespace kreisel::core
