// markdown_test.cpp - `bench report --markdown` as a user runs it, and the files that it has filled.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "apps/run_bench.hpp"
#include "experiment/experiment.hpp"
#include "experiment/table_places.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// README and all of docs/.
std::vector<fs::path> documents() {
  const fs::path source = source_folder;
  std::vector<fs::path> files{source / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(source / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  return files;
}

TEST(Documents, NameCommitAndDateBelowEveryTableOfAnExperiment) {
  const std::regex commit("commit [0-9a-f]{12}\\b"), date("\\b20[0-9]{2}-[0-9]{2}-[0-9]{2}\\b");
  int tables = 0;
  for (const fs::path& file : documents())
    for (const TablePlace& place : table_places(content_of(file), file)) {
      SCOPED_TRACE(fmt::format("{}:{}: {}", file.string(), place.line, place.experiment));
      EXPECT_NO_THROW((void)find_experiment(place.experiment));
      if (place.content.empty()) continue;  // nothing is on record yet
      ++tables;
      EXPECT_NE(place.content.find("|---"), std::string::npos) << "no table";
      EXPECT_TRUE(std::regex_search(place.content, commit));
      EXPECT_TRUE(std::regex_search(place.content, date));
    }
  EXPECT_GE(tables, 10);
}

/// A tiny experiment on record, and one that is not.
class MarkdownReport : public ::testing::Test {
 protected:
  void SetUp() override {
    (void)folder_.write("experiments/tiny.toml",
                        "model = \"ellipsoid\"\nresolution = 24\nfineness = 16\npart = \"none\"\n"
                        "formulation = \"quadric\"\n[[run]]\n");
    (void)folder_.write("experiments/other.toml", "[[run]]\nmodel = \"bird\"\n");
    const BenchAnswer ran = in_folder("run tiny");
    ASSERT_EQ(ran.code, 0) << ran.out;
  }
  [[nodiscard]] BenchAnswer in_folder(const std::string& arguments) const {
    return bench(arguments, fmt::format("cd '{}' &&", folder_.path.string()));
  }

  TemporaryFolder folder_;
};

TEST_F(MarkdownReport, FillsPlacesFromRecordsAndSaysWhatItLeaves) {
  const std::string other = "\n<!-- table: other -->\nas it was\n<!-- end -->\n";
  const fs::path file = folder_.write(
      "a.md", "Text.\n\n<!-- table: tiny columns=\"model, objective\" -->\n<!-- end -->\n" + other);
  const BenchAnswer a = in_folder("report --markdown a.md");
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("other: no records in results/runs, its tables stay as they are\n"),
            std::string::npos);
  EXPECT_NE(a.out.find("a.md: 1 tables from records, 1 left as they are\n"), std::string::npos) << a.out;
  const std::string filled = content_of(file);
  EXPECT_EQ(
      filled.find("Text.\n\n<!-- table: tiny columns=\"model, objective\" -->\n\n| model | objective |\n"),
      0u)
      << filled;
  EXPECT_TRUE(filled.ends_with(other)) << filled;
  EXPECT_TRUE(std::regex_search(filled, std::regex("commit [0-9a-f]{12}.*; 20[0-9-]{8}; load "))) << filled;

  const auto written = fs::last_write_time(file);
  const BenchAnswer again = in_folder("report --markdown a.md");
  EXPECT_NE(again.out.find("; no change\n"), std::string::npos) << again.out;
  EXPECT_EQ(content_of(file), filled);
  EXPECT_EQ(fs::last_write_time(file), written) << "what does not change is not written";
}

TEST_F(MarkdownReport, WritesNoFileWhereOneCannotBeFilled) {
  const std::string place = "<!-- table: tiny -->\n<!-- end -->\n";
  const fs::path good = folder_.write("good.md", place);
  (void)folder_.write("bad.md", "\n<!-- table: tiny columns=\"modle\" -->\n<!-- end -->\n");
  (void)folder_.write("worse.md", "<!-- table: tinny -->\n<!-- end -->\n");
  for (const auto& [bad, why] :
       {std::pair("bad.md", "bad.md: line 2: column 'modle' is unknown (did you mean"),
        std::pair("worse.md", "worse.md: line 1: experiment 'tinny': no such file"),
        std::pair("none.md", "none.md: cannot be read, expected a Markdown file")}) {
    const BenchAnswer a = in_folder(fmt::format("report --markdown good.md {}", bad));
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(why), std::string::npos) << a.out;
    EXPECT_EQ(content_of(good), place);
  }
}

TEST_F(MarkdownReport, FillsOnlyTheExperimentsThatAreNamed) {
  const std::string place = "<!-- table: tiny -->\n<!-- end -->\n";
  const fs::path file = folder_.write("a.md", place);
  EXPECT_EQ(in_folder("report other --markdown a.md").code, 0);
  EXPECT_EQ(content_of(file), place);
  EXPECT_EQ(in_folder("report tiny --markdown a.md").code, 0);
  EXPECT_NE(content_of(file), place);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
