// kept_search_test.cpp - searches that are kept on their way, and islands that hear of each other by what is
// kept.
#include "record/kept_search.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "mesh/io/write.hpp"
#include "nest/known_answers.hpp"
#include "record/nest_record.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A sphere in an ellipsoid.
class Kept : public testing::Test {
 protected:
  Kept() {
    write_mesh(folder_.path / "egg.off", {nest::ball(6, {1.5, 1.2, 1})});
    write_mesh(folder_.path / "ball.off", {nest::ball(6)});
  }
  [[nodiscard]] NestConfig island(int seed, int exchange = 2, int particles = 8) const {
    return make_nest({{"outer", (folder_.path / "egg.off").string()},
                      {"inner", (folder_.path / "ball.off").string()},
                      {"free", "all"},
                      {"particles", std::to_string(particles)},
                      {"iterations", "6"},
                      {"climbs", "0"},
                      {"exchange", std::to_string(exchange)},
                      {"seed", std::to_string(seed)}});
  }
  [[nodiscard]] std::filesystem::path file(int seed) const {
    return folder_.path / "islands" / (std::to_string(seed) + ".checkpoint");
  }
  /// A whole search that is kept on its way, and what it found.
  NestResult search(const NestConfig& config, int seed) const {
    const KeptSearch kept(file(seed));
    NestHooks hooks;
    hooks.keep = [&](const NestCheckpoint& now) { kept.keep(now); };
    hooks.exchange = [&](const NestCheckpoint& now) {
      kept.keep(now);
      return kept.better_elsewhere(now);
    };
    return run_nest(config, hooks);
  }
  /// A checkpoint as it is in the midst of a search, with another scale.
  [[nodiscard]] NestCheckpoint with_scale(int seed, double scale) const {
    NestCheckpoint made = read_checkpoint(file(seed));
    made.state.scale = scale;
    made.state.phase = nest::SearchState::swarming;
    return made;
  }

  const TemporaryFolder folder_;
};

TEST_F(Kept, GoesOnWithWhatIsThereOfTheSameSearchAndHasNotEnded) {
  (void)search(island(1), 1);
  EXPECT_FALSE(KeptSearch(file(1)).begun(island(1))) << "it is over";
  write_checkpoint(file(1), with_scale(1, 0.5));
  EXPECT_TRUE(KeptSearch(file(1)).begun(island(1)));
  EXPECT_FALSE(KeptSearch(file(1)).begun(island(2))) << "another seed";
  EXPECT_FALSE(KeptSearch(file(3)).begun(island(3))) << "nothing there";
  std::ofstream(file(1), std::ios::trunc) << "torn";
  expect_refusal([&] { (void)KeptSearch(file(1)).begun(island(1)); }, file(1).string(), {"HDF5"});
  KeptSearch(file(1)).remove();
  EXPECT_FALSE(std::filesystem::exists(file(1)));
}

TEST_F(Kept, HearsOfTheBestOfTheOthersWhereItIsBetter) {
  for (const int seed : {1, 2, 3}) (void)search(island(seed), seed);
  NestCheckpoint third = with_scale(3, 0.7);
  third.state.best.front() = 0.125;
  write_checkpoint(file(2), with_scale(2, 0.6));
  write_checkpoint(file(3), third);
  const KeptSearch first(file(1));
  EXPECT_EQ(first.better_elsewhere(with_scale(1, 0.5)), third.state.best);
  EXPECT_TRUE(first.better_elsewhere(with_scale(1, 0.7)).empty()) << "none is better";
  // What is torn, or another search's, is passed over.
  std::ofstream(file(4)) << "torn";
  (void)search(island(5, 2, 9), 5);
  NestCheckpoint other = with_scale(5, 0.9);
  write_checkpoint(file(5), other);
  EXPECT_EQ(first.better_elsewhere(with_scale(1, 0.5)), third.state.best);
}

TEST_F(Kept, AnIslandAloneFindsWhatASearchWithoutExchangeFinds) {
  const NestResult alone = search(island(1), 1), without = run_nest(island(1, 0));
  EXPECT_EQ(alone.scale, without.scale);
  EXPECT_EQ(alone.transform, without.transform);
  EXPECT_EQ(alone.evaluations, without.evaluations);
}

TEST_F(Kept, AnIslandEndsNoLowerThanTheBestItHeardOf) {
  const NestResult alone = run_nest(island(1, 0));
  int better = 2;
  while (run_nest(island(better, 0)).scale <= alone.scale) ASSERT_LT(++better, 20);
  const NestResult best = search(island(better), better);  // its checkpoint stays
  EXPECT_GE(search(island(1), 1).scale, best.scale);
}

TEST_F(Kept, APositionThatIsNoneIsPassedOver) {
  const NestResult without = run_nest(island(1, 0));
  for (const std::vector<double>& odd :
       {std::vector<double>{1, 2}, std::vector<double>(without.trace.size() + 40, 0.5)}) {
    NestHooks hooks;
    hooks.exchange = [&](const NestCheckpoint&) { return odd; };
    EXPECT_EQ(run_nest(island(1), hooks).scale, without.scale);
  }
}

TEST_F(Kept, IslandsShareAFolderAndOthersLieBesideTheirRecords) {
  const std::filesystem::path record = "/runs/a/ball-in-egg-swarm-0.h5";
  EXPECT_EQ(checkpoint_of(record, island(1, 0)), "/runs/a/ball-in-egg-swarm-0.checkpoint");
  const auto first = checkpoint_of(record, island(1)), second = checkpoint_of(record, island(2));
  EXPECT_EQ(first.parent_path(), second.parent_path());
  EXPECT_EQ(first.filename(), "1.checkpoint");
  EXPECT_NE(first.parent_path(), checkpoint_of(record, island(1, 3)).parent_path()) << "another search";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
