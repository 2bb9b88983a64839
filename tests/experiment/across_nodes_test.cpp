// across_nodes_test.cpp - a ratio of times that two machines took is marked.
#include "table/across_nodes.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"
#include "table/markdown_table.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RecordedRun made_on(const std::string& host, const std::string& processor, const std::string& formulation,
                    double seconds, const std::map<std::string, std::string>& settings = {}) {
  RunResult r = optimal_result(settings);
  r.config.formulation = formulation;
  r.config.domain = "columns";
  r.median = {0, 0, seconds, seconds};
  r.samples = {r.median};
  r.provenance.host = host;
  r.provenance.processor = processor;
  return recorded(r);
}

constexpr const char* meaning = "different nodes or processors";

TEST(AcrossNodes, ASpeedUpIsMarkedInTextAndMarkdownAndNotInCsv) {
  const Tables tables =
      tables_by("speedup", {made_on("north", "one", "rayrep", 0.5), made_on("south", "one", "voxel", 4)});
  EXPECT_NE(to_text(tables).find("8.00 †"), std::string::npos) << to_text(tables);
  EXPECT_NE(to_text(tables).find(meaning), std::string::npos);
  EXPECT_NE(to_markdown(tables).find("8.00 †"), std::string::npos);
  EXPECT_NE(to_markdown(tables).find(meaning), std::string::npos);
  EXPECT_EQ(to_csv(tables).find("†"), std::string::npos);
}

TEST(AcrossNodes, NothingIsMarkedOfOneMachineOrOfOneThatIsNotKnown) {
  for (const char* host : {"north", ""}) {
    const std::string text = to_text(
        tables_by("speedup", {made_on("north", "one", "rayrep", 0.5), made_on(host, "one", "voxel", 4)}));
    EXPECT_EQ(text.find("†"), std::string::npos) << text;
  }
}

TEST(AcrossNodes, AnotherProcessorIsAnotherMachine) {
  EXPECT_TRUE(are_across_nodes(made_on("n", "one", "rayrep", 1), made_on("n", "two", "rayrep", 1)));
  EXPECT_FALSE(are_across_nodes(made_on("n", "one", "rayrep", 1), made_on("n", "one", "voxel", 1)));
}

TEST(AcrossNodes, ARatioOfTimesIsMarkedAndOneOfObjectivesIsNot) {
  const RecordedRun ray = made_on("north", "one", "rayrep", 0.5), voxel = made_on("south", "one", "voxel", 4);
  const RunGroup group({&ray, &voxel});
  const Row row{{&ray}, &group};
  EXPECT_TRUE(is_across_nodes(row, "ratio(seconds.solve, formulation=voxel)"));
  EXPECT_FALSE(is_across_nodes(row, "ratio(objective, formulation=voxel)"));
  EXPECT_FALSE(is_across_nodes(row, "ratio(seconds.solve, formulation=rayrep)")) << "itself";
  EXPECT_FALSE(is_across_nodes(row, "seconds.solve")) << "one run's";
}

TEST(AcrossNodes, TheTableOfSettingsMarksItsTimesToo) {
  const std::string text = to_text(
      tables_by("settings", {made_on("north", "one", "rayrep", 1),
                             made_on("north", "one", "rayrep", 2, {{"ipopt.mu_strategy", "adaptive"}}),
                             made_on("south", "one", "rayrep", 3, {{"ipopt.tol", "1e-4"}})}));
  EXPECT_NE(text.find(" 3.00 †"), std::string::npos) << text;
  EXPECT_EQ(text.find(" 2.00 †"), std::string::npos) << text;
  EXPECT_NE(text.find(meaning), std::string::npos);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
