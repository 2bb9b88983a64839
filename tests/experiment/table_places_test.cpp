#include "experiment/table_places.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const std::string file =
    "# A file\n"
    "\n"
    "<!-- table: one -->\n"
    "| old |\n"
    "<!-- end -->\n"
    "\n"
    "    <!-- table: an example, indented -->\n"
    "<!-- table: two block=\"best\" columns=\"model, f\" -->\n"
    "<!-- end -->\n"
    "The end, without a newline";

TEST(TablePlaces, AreFoundWithWhatTheyAskFor) {
  const std::vector<TablePlace> places = table_places(file, "a.md");
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].experiment, "one");
  EXPECT_EQ(places[0].line, 3u);
  EXPECT_EQ(places[0].content, "| old |");
  EXPECT_TRUE(places[0].selection.blocks.empty() && places[0].selection.columns.empty());
  EXPECT_EQ(places[1].experiment, "two");
  EXPECT_EQ(places[1].selection.blocks, std::vector<std::string>{"best"});
  EXPECT_EQ(places[1].selection.columns, (std::vector<std::string>{"model", "f"}));
  EXPECT_EQ(places[1].content, "");
}

TEST(TablePlaces, AreFilledAndAllElseStaysAsItIs) {
  const auto content = [](const TablePlace& place) {
    return std::optional("| " + place.experiment + " |\n");
  };
  const std::string filled = fill_places(file, "a.md", content);
  EXPECT_EQ(filled,
            "# A file\n"
            "\n"
            "<!-- table: one -->\n"
            "\n| one |\n\n"
            "<!-- end -->\n"
            "\n"
            "    <!-- table: an example, indented -->\n"
            "<!-- table: two block=\"best\" columns=\"model, f\" -->\n"
            "\n| two |\n\n"
            "<!-- end -->\n"
            "The end, without a newline");
  EXPECT_EQ(fill_places(filled, "a.md", content), filled) << "done twice it is the same";
}

TEST(TablePlaces, StayAsTheyAreWhereThereIsNothingForThem) {
  EXPECT_EQ(fill_places(file, "a.md", [](const TablePlace&) { return std::nullopt; }), file);
  EXPECT_EQ(fill_places("", "a.md", [](const TablePlace&) { return std::nullopt; }), "");
  const std::string one = fill_places(file, "a.md", [](const TablePlace& place) {
    return place.experiment == "two" ? std::optional<std::string>("| new |") : std::nullopt;
  });
  EXPECT_NE(one.find("| old |\n<!-- end -->"), std::string::npos) << one;
  EXPECT_NE(one.find("\n\n| new |\n\n<!-- end -->"), std::string::npos) << one;
}

TEST(TablePlaces, ThatCannotBeReadAreRefusedWithTheirLine) {
  const auto refused = [](const std::string& text, const std::string& why) {
    expect_refusal([&] { (void)table_places(text, "a.md"); }, why, {});
  };
  refused("\n<!-- table: one -->\ntext\n",
          "a.md: line 2: the table of one has no end, expected a line <!-- end -->");
  refused("<!-- end -->\n",
          "a.md: line 1: <!-- end --> without a table, expected <!-- table: NAME --> before it");
  refused("<!-- table: one -->\n<!-- table: two -->\n<!-- end -->",
          "a.md: line 2: a table within that of line 1, expected <!-- end --> first");
  refused("<!-- table: one\n-->\n<!-- end -->", "a.md: line 1: a mark that does not end, expected -->");
  refused("<!-- table: -->\n<!-- end -->", "a.md: line 1: a table of no experiment, expected its name");
  refused("<!-- table: one rows=\"2\" -->\n<!-- end -->",
          "a.md: line 1: rows=\"2\" of a table, expected block, columns or joined=\"yes\"");
  refused("<!-- table: one block=best -->\n<!-- end -->",
          "a.md: line 1: 'block=best', expected block=\"NAME\" or columns=\"NAME, NAME\"");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
