#include "table/markdown_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Tables two_blocks() {
  const auto sheet_with = [](const std::string& name) {
    Sheet sheet({{"name", "", "name", true},
                 {"all_digits", "", ""},
                 {"", "g", "seen"},
                 {"value", "g", "v", false, true}});
    sheet.add({name, "1.25", "x|y", Cell::of(0.5, "{:.2f}")});
    return sheet;
  };
  return {{{"first\n  more of it", sheet_with("a"), "! a note\n"}, {"second", sheet_with("b"), ""}},
          "what it means\n"};
}

TEST(Markdown, SetsOutBlocksWithNotesAndLegend) {
  EXPECT_EQ(to_markdown(two_blocks()),
            "**first**\n\n- more of it\n\n"
            "| name | g: seen |\n|---|---:|\n| a | x\\|y |\n\n- ! a note\n\n"
            "**second**\n\n"
            "| name | g: seen |\n|---|---:|\n| b | x\\|y |\n\n"
            "- what it means\n");
}

TEST(Markdown, ShowsTheBlocksAndColumnsThatAreAskedFor) {
  EXPECT_EQ(to_markdown(two_blocks(), {{"second"}, {"value", "all_digits", "name"}}),
            "**second**\n\n| g: v | all digits | name |\n|---:|---:|---|\n| 0.50 | 1.25 | b |\n\n"
            "- what it means\n");
}

TEST(Markdown, JoinsTheRowsOfAllBlocksWhereAsked) {
  EXPECT_EQ(to_markdown(two_blocks(), {{}, {"name"}, true}),
            "| name |\n|---|\n| a |\n| b |\n\n- ! a note\n- what it means\n");
}

TEST(Markdown, RefusesBlocksAndColumnsThatThereAreNot) {
  expect_refusal(
      [] {
        (void)to_markdown(two_blocks(), {{"third"}, {}});
      },
      "block 'third' is unknown", {"first, second"});
  expect_refusal(
      [] {
        (void)to_markdown(two_blocks(), {{}, {"seen"}});
      },
      "column 'seen' is unknown", {"name, all_digits, value"});
}

TEST(Markdown, WrapsLongNotesInsideTheirItem) {
  Tables tables = two_blocks();
  for (int i = 0; i < 60; ++i) tables.legend.insert(0, "word ");
  std::istringstream lines(to_markdown(tables));
  int indented = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 120u) << line;
    if (line.starts_with("  word")) ++indented;
  }
  EXPECT_EQ(indented, 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
