// markdown_table.hpp - the tables of an experiment as they stand in a Markdown file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "table/sheet.hpp"

namespace kreisel::core {

/// What a file shows of them.
struct Selection {
  std::vector<std::string> blocks;   ///< how their headings begin; empty: all
  std::vector<std::string> columns;  ///< by the names of the CSV, in this order; empty: those of the text
  bool joined = false;               ///< the rows of all blocks in one table, without their headings
};

/// Blocks as pipe tables, each under its heading where there is one, then notes and legend as a list, wrapped
/// at 120 columns. Groups stand ahead of the headings: "ray-rep: seconds". A column that people do not see in
/// the text is headed by the name it has in CSV. Ends with a newline.
///
/// @throws InputError  no block that begins so, or no column of that name; lists those there are
[[nodiscard]] std::string to_markdown(const Tables& tables, const Selection& selection = {});

}  // namespace kreisel::core
