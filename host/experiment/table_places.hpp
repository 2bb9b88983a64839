// table_places.hpp - where a Markdown file keeps an experiment's table, between two marks.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "table/markdown_table.hpp"

namespace kreisel::core {

/// A place of a file. Marks stand at the beginning of a line of their own:
///
///     <!-- table: rayrep_table2 block="best" columns="model, grid, speedup" -->
///     what was written last
///     <!-- end -->
///
/// `block` is how the heading of a block begins, and may be there several times; `columns` names columns,
/// with commas between them; joined="yes" makes one table of all blocks. Each may be left out.
struct TablePlace {
  std::string experiment;
  Selection selection;
  std::size_t line = 0;  ///< of the first mark, from 1
  std::string content;   ///< between the marks, empty lines around it left out
};

/// @param file  for messages
/// @throws InputError  "FILE: line N: ...": a mark that cannot be read, or has no partner
[[nodiscard]] std::vector<TablePlace> table_places(const std::string& text,
                                                   const std::filesystem::path& file);

/// The text with new content in its places; all else stays as it is, byte by byte. Done twice it is the same.
///
/// @param content_of  what is to stand there; none: the place stays as it is
/// @throws InputError  as table_places()
[[nodiscard]] std::string fill_places(
    const std::string& text, const std::filesystem::path& file,
    const std::function<std::optional<std::string>(const TablePlace& place)>& content_of);

}  // namespace kreisel::core
