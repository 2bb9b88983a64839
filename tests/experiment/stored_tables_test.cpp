// stored_tables_test.cpp - layouts print what the code did that they replaced: records of experiments, as
// their summaries, beside the tables that were printed of them then (tests/data/tables).
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "experiment/experiment_table.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

fs::path folder() { return data_folder() / "tests/data/tables"; }

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<RecordedRun> runs_in(const fs::path& file) {
  std::vector<RecordedRun> runs;
  for (const nlohmann::json& stored : nlohmann::json::parse(content_of(file))) {
    RecordedRun& run = runs.emplace_back();
    Record& record = run.record.emplace();
    record.path = "record.h5";
    record.summary = stored.at("summary");
    record.error = stored.at("error");
    run.run.label = stored.at("label");
    if (stored.at("summary").contains("shapes")) record.kind = RecordKind::nesting;
    std::vector<GivenText> given;
    for (const auto& [name, text] : record.config()) given.push_back({name, text});
    run.run.run = make_run(given);
  }
  return runs;
}

class StoredTables : public testing::TestWithParam<std::string> {};

TEST_P(StoredTables, ArePrintedAsTheyWere) {
  const std::string name = GetParam();
  const Experiment experiment = read_experiment(data_folder() / "experiments" / (name + ".toml"));
  const std::vector<RecordedRun> runs = runs_in(folder() / (name + ".json"));
  ASSERT_FALSE(runs.empty());
  EXPECT_EQ(table_text(experiment, runs), content_of(folder() / (name + ".txt")));
}

INSTANTIATE_TEST_SUITE_P(Experiments, StoredTables,
                         testing::Values("certificate", "nest_seeds", "nest_table1", "rayrep_table1",
                                         "rayrep_table2", "spinit_slsqp", "spinit_standing", "spinit_teapot",
                                         "spinit_voids", "spinit_yoyo"));

}  // namespace THIS_FILE
}  // namespace kreisel::core
