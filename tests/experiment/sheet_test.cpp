#include "table/sheet.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace kreisel::core {
namespace THIS_FILE {

TEST(Cell, RoundsForReadersAndKeepsAllDigitsForPrograms) {
  EXPECT_EQ(Cell::of(1.0 / 3, "{:.2f}").text, "0.33");
  EXPECT_EQ(std::stod(Cell::of(1.0 / 3, "{:.2f}").data), 1.0 / 3);
  EXPECT_EQ(Cell::of(-1e-9, "{:.2f}").text, "0.00") << "what rounds to nothing has no sign";
  EXPECT_EQ(Cell::of(-0.3, "{:.1f}").text, "-0.3");
}

TEST(Cell, ShowsADashForWhatIsNotThere) {
  for (const Cell& cell : {Cell(""), Cell::none(), Cell::of({}, "{:g}"),
                           Cell::of(std::numeric_limits<double>::quiet_NaN(), "{:g}")}) {
    EXPECT_EQ(cell.text, "-");
    EXPECT_EQ(cell.data, "");
  }
}

Sheet two_rows() {
  Sheet sheet({{"name", "", "name", true}, {"exact", "", ""}, {"", "g", "seen"}, {"value", "g", "v"}});
  sheet.add({"a", "1.25", "x", Cell::of(0.5, "{:.2f}")});
  sheet.add({"b", "", "y", Cell::none()});
  return sheet;
}

TEST(Sheet, GivesTextWithoutColumnsOfDataAndCsvWithoutColumnsOfText) {
  EXPECT_EQ(two_rows().text(),
            "     |     g\n"
            "name | seen     v\n"
            "-----+-----------\n"
            "a    |    x  0.50\n"
            "b    |    y     -\n");
  EXPECT_EQ(two_rows().csv_heading() + two_rows().csv_rows(), "name,exact,value\na,1.25,0.5\nb,,\n");
  EXPECT_THROW(two_rows().add({"one"}), std::invalid_argument);
}

TEST(Tables, PutBlocksBelowEachOtherAndOneHeadingOverTheirCsv) {
  const Tables tables{{{"first", two_rows(), "! note\n"}, {"", two_rows(), ""}}, "what it means\n"};
  EXPECT_EQ(to_text(tables),
            "first\n" + two_rows().text() + "! note\n\n" + two_rows().text() + "\nwhat it means\n");
  EXPECT_EQ(to_csv(tables), two_rows().csv_heading() + two_rows().csv_rows() + two_rows().csv_rows());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
