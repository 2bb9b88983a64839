#include "record/nest_record.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesh/io/write.hpp"
#include "nest/known_answers.hpp"
#include "record/hdf5_file.hpp"
#include "record/record.hpp"
#include "record/records_in.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A sphere in an ellipsoid, in files.
class NestRecord : public testing::Test {
 protected:
  NestRecord() {
    write_mesh(folder_.path / "egg.off", {nest::ball(6, {1.5, 1.2, 1})});
    write_mesh(folder_.path / "ball.off", {nest::ball(6)});
    ask({});
  }
  void ask(const GivenFields& more) {
    GivenFields given = {{"outer", (folder_.path / "egg.off").string()},
                         {"inner", (folder_.path / "ball.off").string()}};
    given.insert(given.end(), more.begin(), more.end());
    config_ = make_nest(given);
  }
  void search() {
    ask({{"free", "all"},
         {"particles", "12"},
         {"iterations", "10"},
         {"climb-iterations", "15"},
         {"swarms", "2"},
         {"patience", "4"},
         {"topology", "random"},
         {"seed", "3"}});
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path / "nest.h5"; }

  const TemporaryFolder folder_;
  NestConfig config_;
  NestHooks hooks_;
};

TEST_F(NestRecord, HoldsWhatWasAskedAndFound) {
  search();
  set_field(config_, "timings", "1");
  const NestResult result = run_nest(config_, hooks_);
  ASSERT_TRUE(result.valid) << result.text;
  write_nest(file(), result);
  ASSERT_EQ(kind_of_record(file()), RecordKind::nesting);
  const NestResult read = read_nest(file());
  // All that people and scripts are told of a nesting is in its record.
  EXPECT_EQ(read_record(file()).summary.whole(), to_json(result));
  EXPECT_EQ(describe(read.config), describe(config_));
  EXPECT_EQ(kind_of(read.config), "swarm");
  EXPECT_EQ(shapes_text(read.config), "ball in egg");
  EXPECT_EQ(termination_of(read), "valid");
  EXPECT_EQ(read.scale, result.scale);
  EXPECT_EQ(read.evaluations, result.evaluations);
  EXPECT_EQ(read.outer_triangles, 20u * 36);
  ASSERT_EQ(read.trace.size(), result.trace.size());
  ASSERT_EQ(result.trace_seconds.size(), result.trace.size());
  EXPECT_EQ(read.trace.back().best, result.scale);
  EXPECT_EQ(read.trace_seconds.back(), result.trace_seconds.back());
  EXPECT_GE(read.certified.value().scale, result.scale) << "what hybrid finds holds on the triangles";
  EXPECT_GE(read.sampled_scale.value(), result.scale) << "samples are optimistic";
  ASSERT_EQ(read.timings.size(), 4u);
  for (const NestTiming& timing : read.timings) {
    EXPECT_GT(timing.test_ms, 0) << timing.variant;
    // The search alone may find a little more at the same place; samples, a pixel's worth.
    EXPECT_NEAR(timing.scale, result.scale, 0.01) << timing.variant;
  }
  const nlohmann::json json = to_json(result);
  EXPECT_EQ(json.at("scale"), result.scale);
  EXPECT_EQ(json.at("trace").size(), result.trace.size());
  EXPECT_EQ(json.at("timings").size(), 4u);
}

TEST_F(NestRecord, HoldsTestsScalesComparisonsAndFailures) {
  ask({{"scale", "1.2"}});
  write_nest(file(), run_nest(config_, hooks_));
  NestResult read = read_nest(file());
  EXPECT_EQ(kind_of(read.config), "test");
  EXPECT_EQ(termination_of(read), "infeasible");
  EXPECT_EQ(read.scale, 1.2);
  EXPECT_FALSE(read.certified);

  ask({{"variant", "envelope"}});
  write_nest(file(), run_nest(config_, hooks_));
  read = read_nest(file());
  EXPECT_EQ(kind_of(read.config), "scale");
  EXPECT_TRUE(read.valid);
  EXPECT_NEAR(read.certified.value().scale, read.scale, 0.01) << "repaired where samples missed a contact";

  ask({{"accuracy", "3"}});
  write_nest(file(), run_nest(config_, hooks_));
  read = read_nest(file());
  EXPECT_EQ(kind_of(read.config), "accuracy");
  EXPECT_EQ(read.accuracy.value().placements, 3);
  ASSERT_EQ(read.accuracy->errors.size(), 4u);
  EXPECT_EQ(read.accuracy->errors.back().resolution, 512);

  write_failure(file(), config_, {}, "no such shape");
  const Record failed = read_record(file());
  EXPECT_EQ(failed.error, "no such shape");
  EXPECT_EQ(failed.config(), describe(config_));
}

TEST_F(NestRecord, ASearchGoesOnFromACheckpointAsIfItHadNeverStopped) {
  search();
  const NestResult whole = run_nest(config_, hooks_);
  for (const int stop : {1, 6, 17}) {  // in the swarm, after a restart, in the climb
    int asked = 0;
    NestHooks stopping;
    std::stop_source source;
    stopping.control = {source.get_token(), [&](const std::string& step) {
                          const bool one = step.starts_with("iteration") || step.starts_with("refining");
                          if (one && ++asked >= stop) source.request_stop();
                        }};
    stopping.keep = [&](const NestCheckpoint& checkpoint) { write_checkpoint(file(), checkpoint); };
    const NestResult part = run_nest(config_, stopping);
    EXPECT_EQ(part.ending, NestResult::Ending::interrupted);
    EXPECT_LE(part.trace.size(), std::size_t(stop)) << "a step that begins a climb asks for nothing";
    EXPECT_LT(part.trace.size(), whole.trace.size());
    EXPECT_EQ(termination_of(part), "interrupted");

    const NestCheckpoint checkpoint = read_checkpoint(file());
    EXPECT_EQ(describe(checkpoint.config), describe(config_));
    NestHooks going_on = hooks_;
    going_on.resume = &checkpoint;
    const NestResult rest = run_nest(checkpoint.config, going_on);
    EXPECT_EQ(rest.scale, whole.scale) << stop;
    EXPECT_EQ(rest.transform, whole.transform) << stop;
    EXPECT_EQ(rest.evaluations, whole.evaluations) << stop;
    ASSERT_EQ(rest.trace.size(), whole.trace.size()) << stop;
    EXPECT_EQ(rest.trace_seconds.size(), rest.trace.size()) << stop;
    EXPECT_TRUE(std::ranges::is_sorted(rest.trace_seconds)) << stop;
  }
}

TEST_F(NestRecord, RefusesOtherFilesAndCheckpointsOfOtherSearches) {
  ask({{"scale", "0.5"}});
  write_nest(file(), run_nest(config_, hooks_));
  expect_refusal([&] { (void)read_checkpoint(file()); }, file().string(), {"not a checkpoint of a nesting"});
  search();
  NestHooks keeping = hooks_;
  keeping.keep = [&](const NestCheckpoint& checkpoint) { write_checkpoint(file(), checkpoint); };
  (void)run_nest(config_, keeping);
  expect_refusal([&] { (void)read_nest(file()); }, file().string(), {"not a nesting"});
  NestCheckpoint checkpoint = read_checkpoint(file());
  checkpoint.state.swarm.own_value.pop_back();
  keeping.resume = &checkpoint;
  expect_refusal([&] { (void)run_nest(config_, keeping); }, "a checkpoint that does not fit", {"2 swarms"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
