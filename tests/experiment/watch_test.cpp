// watch_test.cpp - how far an experiment is, by records that others make.
#include "experiment/watch.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "experiment/recorded_runs.hpp"
#include "record/records_in.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class Watched : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path record(std::size_t i) const {
    return record_path(folder.path, experiment.name, experiment.runs[i]);
  }
  /// As if made so many seconds ago.
  void finish(std::size_t i, const std::string& node, int ago) const {
    std::filesystem::create_directories(record(i).parent_path());
    RunResult result = optimal_result();
    result.config = experiment.runs[i].solve();
    result.provenance.host = node;
    write_record(record(i), result);
    std::filesystem::last_write_time(
        record(i), std::filesystem::file_time_type::clock::now() - std::chrono::seconds(ago));
  }

  const TemporaryFolder folder;
  const Experiment experiment = parse_experiment(
      "[[run]]\nset.moment.seed = [1, 2, 3, 4, 5]\nsolver = 'moment'\n"
      "formulation = 'quadric'\n[[run]]\nlabel = 'again'\n"
      "set.moment.seed = 1\nsolver = 'moment'\nformulation = 'quadric'\n",
      "trial.toml");
};

TEST_F(Watched, ByItsRecordsAlone) {
  Watch watch(experiment, folder.path);
  EXPECT_EQ(text_of(watch.look()), "0 of 5 runs") << "two labels share one";
  finish(0, "north", 100);
  EXPECT_EQ(text_of(watch.look()), "1 of 5 runs; north 1") << "one has no pace";
  finish(1, "south", 50);
  write_failure(
      record(2), experiment.runs[2].run,
      [] {
        Provenance p;
        p.host = "south";
        return p;
      }(),
      "no memory");
  const Seen seen = watch.look();
  EXPECT_EQ(seen.finished, 2u);
  EXPECT_EQ(seen.failed, 1u);
  EXPECT_FALSE(seen.over());
  ASSERT_TRUE(seen.seconds_left);
  EXPECT_NEAR(*seen.seconds_left, 100, 5) << "two in the 100 s since the first, two are left";
  EXPECT_EQ(text_of(watch.look()).find("3 of 5 runs, 1 failed; about "), 0u) << text_of(watch.look());
  EXPECT_NE(text_of(watch.look()).find(" left; north 1, south 2"), std::string::npos);
  finish(3, "north", 10);
  finish(4, "north", 0);
  EXPECT_EQ(text_of(watch.look()), "5 of 5 runs, 1 failed; north 3, south 2");
  EXPECT_TRUE(watch.look().over());
  finish(2, "south", 0);
  EXPECT_EQ(text_of(watch.look()), "5 of 5 runs; north 3, south 2") << "it was made again";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
