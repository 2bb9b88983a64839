// shard_test.cpp - shares of an experiment: disjoint, whole, about equal, and what is compared in one of
// them.
#include "experiment/shard.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiment/progress.hpp"
#include "experiment/runner.hpp"
#include "refusal.hpp"
#include "run/run.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Experiment experiment(const std::string& table, const std::string& more = "") {
  return parse_experiment(fmt::format("table = '{}'\nmodel = ['ellipsoid', 'bird', 'heart']\n"
                                      "resolution = [16, 20, 24, 32, 40]\nformulation = ['rayrep', 'voxel']\n"
                                      "{}[[run]]\nlabel = 'one'\n",
                                      table, more),
                          "sweep.toml");
}

std::string name_of(const ExperimentRun& run) { return run.label + ' ' + run_name(run.run); }

/// The shard that each run is in.
std::map<std::string, std::size_t> shards_of(const Experiment& whole, std::size_t count) {
  std::map<std::string, std::size_t> shard;
  for (std::size_t k = 1; k <= count; ++k)
    for (const ExperimentRun& run : share_of(whole, {k, count}).runs)
      EXPECT_TRUE(shard.emplace(name_of(run), k).second) << "in two shards: " << name_of(run);
  EXPECT_EQ(shard.size(), whole.runs.size());
  return shard;
}

TEST(Shard, IsReadFromItsText) {
  EXPECT_EQ(shard_of("2/8").number, 2u);
  EXPECT_EQ(shard_of("2/8").of, 8u);
  for (const char* text : {"", "2", "0/2", "3/2", "-1/2", "1/0", "a/b", "1/2/3", "1.5/2"})
    expect_refusal([&] { (void)shard_of(text); }, "shard = '", {"expected I/N"});
}

TEST(Shard, OneOfOneIsTheWholeInItsOrder) {
  const Experiment whole = experiment("runs"), all = share_of(whole, {1, 1});
  ASSERT_EQ(all.runs.size(), whole.runs.size());
  for (std::size_t i = 0; i < all.runs.size(); ++i) EXPECT_EQ(name_of(all.runs[i]), name_of(whole.runs[i]));
}

TEST(Shard, SharesAreAboutEqualInEachKindOfWork) {
  // Longest first: no share has more than another by over its last, which is no heavier than any before.
  for (const std::size_t count : {2, 3, 7}) {
    const Experiment whole = experiment("runs");
    (void)shards_of(whole, count);
    std::map<std::string, std::vector<double>> loads;
    std::map<std::string, double> heaviest;
    for (std::size_t k = 1; k <= count; ++k)
      for (const ExperimentRun& run : share_of(whole, {k, count}).runs) {
        const Effort effort = effort_of(run);
        auto& load = loads[effort.kind];
        load.resize(count);
        load[k - 1] += effort.weight;
        heaviest[effort.kind] = std::max(heaviest[effort.kind], effort.weight);
      }
    ASSERT_EQ(loads.size(), 2u);
    for (const auto& [kind, load] : loads)
      EXPECT_LE(std::ranges::max(load) - std::ranges::min(load), heaviest[kind]) << kind << ' ' << count;
  }
}

TEST(Shard, RunsThatATableComparesStayTogether) {
  // A row of `speedup` is a model and grid; a block of `settings` a formulation of those, with all settings.
  const Experiment speedup = experiment("speedup"),
                   settings = experiment("settings", "set.ipopt.tol = [1e-4, 1e-5, 1e-6]\n");
  for (const std::size_t count : {2, 4, 40}) {
    const auto of_rows = shards_of(speedup, count), of_blocks = shards_of(settings, count);
    for (const ExperimentRun& a : speedup.runs)
      for (const ExperimentRun& b : speedup.runs)
        if (a.asked().body.model == b.asked().body.model &&
            a.asked().grid.resolution == b.asked().grid.resolution) {
          EXPECT_EQ(of_rows.at(name_of(a)), of_rows.at(name_of(b)));
        }
    std::set<std::size_t> used;
    for (const ExperimentRun& a : settings.runs) {
      used.insert(of_blocks.at(name_of(a)));
      for (const ExperimentRun& b : settings.runs)
        if (a.asked().body.model == b.asked().body.model &&
            a.asked().grid.resolution == b.asked().grid.resolution &&
            a.asked().formulation == b.asked().formulation) {
          EXPECT_EQ(of_blocks.at(name_of(a)), of_blocks.at(name_of(b)));
        }
    }
    EXPECT_EQ(used.size(), std::min<std::size_t>(count, 30)) << "none is empty while there are blocks";
  }
}

TEST(Shard, ARunUnderTwoLabelsIsMadeInOne) {
  const Experiment twice = experiment("runs", "[[run]]\nlabel = 'other'\n");
  const auto shard = shards_of(twice, 5);
  for (const ExperimentRun& run : twice.runs) {
    const std::string own = run_name(run.run);
    EXPECT_EQ(shard.at("one " + own), shard.at("other " + own));
  }
}

TEST(Shard, ADryRunNamesEveryRecordOnceAndNothingElse) {
  const Experiment whole = experiment("speedup");
  std::set<std::string> records;
  std::size_t named = 0;
  for (std::size_t k = 1; k <= 3; ++k) {
    const std::string text = dry_run(share_of(whole, {k, 3}));
    for (std::size_t at = text.find(".h5"); at != text.npos; at = text.find(".h5", at + 1), ++named)
      records.insert(text.substr(text.rfind(' ', at) + 1, at - text.rfind(' ', at) + 2));
  }
  EXPECT_EQ(named, whole.runs.size());
  EXPECT_EQ(records.size(), whole.runs.size());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
