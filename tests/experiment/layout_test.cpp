// layout_test.cpp - tables as data: what a layout can say, and what is refused.
#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Layout layout_of(const std::string& text) { return read_layout(toml::parse(text), "own", "own.toml"); }

/// By ray-reps in 0.5 s and by voxels in 4 s.
std::vector<RecordedRun> two_ways() {
  const RecordedRun voxel = changed_run([](RunResult& r) {
    r.config.formulation = "voxel";
    r.median.solve = 4;
  });
  return {recorded(optimal_result()), voxel};
}

std::string only_cell(const std::string& column, const std::vector<RecordedRun>& runs) {
  const Tables tables = tables_of(layout_of("columns = [" + column + "]"), runs, {});
  return tables.blocks.at(0).sheet.rows().at(0).at(0).text;
}

TEST(Layout, HasColumnsOfTheProgramOfARecordAndOfWhatWasAsked) {
  EXPECT_EQ(only_cell("'termination'", two_ways()), "optimal");
  EXPECT_EQ(only_cell("'seconds.solve'", two_ways()), "0.5");
  EXPECT_EQ(only_cell("{ name = 's', value = 'seconds.solve', format = '.2f' }", two_ways()), "0.50");
  EXPECT_EQ(only_cell("'asked.wall'", two_ways()), "1.5h");
  EXPECT_EQ(only_cell("{ name = 'w', value = '{model}: {variables}' }", two_ways()), "ellipsoid: 1300");
}

TEST(Layout, ReckonsWithThem) {
  EXPECT_EQ(only_cell("{ name = 'x', value = '1e-3 * variables + 2' }", two_ways()), "3.3");
  EXPECT_EQ(only_cell("{ name = 'x', value = 'abs(objective - 1) / 2', format = '.1f' }", two_ways()), "0.1");
  EXPECT_EQ(only_cell("'ratio(seconds.solve, formulation=voxel)'", two_ways()), "8");
  // A number that there is not leaves the cell empty, as does a division by zero.
  EXPECT_EQ(only_cell("'bound / 2'", two_ways()), "-");
  EXPECT_EQ(only_cell("'variables / seconds.setup'", two_ways()), "-");
}

TEST(Layout, SetsRunsOfARowBesideEachOther) {
  const Tables tables = tables_of(
      layout_of(
          "rows = ['model', 'grid']\nheading = ['{formulation}']\nfooter = ['{bound}', 'of {model}']\n"
          "columns = ['model', { name = 'r', value = 'seconds.solve[formulation=rayrep]' }, { name = 'v', "
          "value = 'seconds.solve[formulation!=rayrep]' }, { name = 'gap', when = 'gap' }]"),
      two_ways(), {});
  ASSERT_EQ(tables.blocks.size(), 1u);
  EXPECT_EQ(tables.blocks[0].heading, "rayrep | voxel");
  EXPECT_EQ(tables.blocks[0].notes, "of ellipsoid\n") << "a line without its values is not there";
  ASSERT_EQ(tables.blocks[0].sheet.rows().size(), 1u);
  EXPECT_EQ(to_csv(tables), "model,r,v\nellipsoid,0.5,4\n");
}

TEST(Layout, OfAnExperimentNeedsNoFileOfItsOwn) {
  const Experiment experiment = parse_experiment(
      "[table]\ncolumns = ['model', 'variables']\n[[run]]\nformulation = ['rayrep', 'voxel']", "t.toml");
  ASSERT_TRUE(experiment.layout);
  EXPECT_EQ(table_csv(experiment, two_ways()), "model,variables\nellipsoid,1300\nellipsoid,1300\n");
}

TEST(Layout, RefusesWhatItCannotReadInOneLine) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& says) {
    expect_refusal([&] { (void)layout_of(text); }, "own.toml: line ", says);
  };
  refused("columns = ['variabels']", {"'variabels'", "did you mean 'variables'"});
  refused("columns = ['2 * seconds.solve + objectiv']", {"'objectiv'", "did you mean 'objective'"});
  refused("columns = ['seconds.solve[formulation=voxel']", {"expected ]"});
  refused("columns = ['ratio(seconds.solve, formulation=voxel']", {"expected )"});
  refused("columns = ['ratio(seconds.solve)']", {"expected a name and a field"});
  refused("columns = ['variables +']", {"own.toml: line 1"});
  refused("columns = [{ nam = 'x' }]", {"key 'nam' is unknown", "did you mean 'name'"});
  refused("columns = [{ name = 'variables', format = 'x' }]", {"format = \"x\""});
  refused("columns = [{ value = '{variables:x}' }]", {"own.toml: line 1"});
  refused("columns = [1]", {"expected a name in quotes"});
  refused("columns = ['model']\nnotes = 'all'", {"\"failed\""});
  refused("rows = ['model']", {"expected at least one"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
