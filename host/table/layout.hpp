// layout.hpp - how a table sets runs out, as data: experiments/tables/NAME.toml, or [table] of an experiment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "table/row.hpp"
#include "toml.hpp"

namespace kreisel::core {

struct LayoutColumn {
  std::string name;            ///< in CSV; empty: not there
  std::string value;           ///< what value_of(Row) takes, or a pattern that text_of() takes
  std::string group, heading;  ///< in text; no heading: not there
  std::string format;          ///< of numbers; empty: the value's own
  std::string join = ", ";     ///< between the items of a list
  std::string paper;           ///< a pattern: what a row of the paper that no run belongs to has here
  bool left = false;
  bool once = false;                   ///< of rows that an item of a record makes: people see it in the first
  std::vector<Condition> when;         ///< each for some run, or the column is not there
  std::vector<Condition> hidden_when;  ///< all of them for some run, and people do not see the column
  std::optional<Condition> blank_when, parentheses_when;  ///< of a row: no value; one that is no measure
};

/// A line below a table, and when it stands there.
struct LayoutLine {
  std::string pattern;
  std::vector<Condition> when;
};

struct Layout {
  enum class Notes { unless_optimal, failed, missing };  ///< which runs are told of below the rows

  std::string name, summary;
  std::string of;                   ///< the kind of run that it sets out: solve, map, nesting; empty: any
  std::vector<std::string> rows;    ///< fields that tell rows apart; empty: a row a run
  std::vector<std::string> groups;  ///< fields that tell blocks apart; "run": a block a run; empty: one block
  std::string each;                 ///< a list in a record with a row an item
  std::optional<Condition> only;    ///< runs that have rows; none: all
  std::vector<std::string> heading, footer;  ///< patterns, a line each; without a value the line is not there
  std::vector<LayoutLine> legend;
  Notes notes = Notes::unless_optimal;
  std::string note;           ///< a pattern: what the table calls a run in its notes
  bool as_published = false;  ///< rows in the order in which the paper has them
  std::string paper_rows;     ///< rows of the paper with this value that no run belongs to come last
  std::string paper_rows_in;  ///< they come in the blocks that begin with this field of theirs; empty: last
  std::vector<LayoutColumn> columns;
};

/// @param where  for messages, such as a file
/// @throws InputError  an unknown key or name, a value of another type; says what was expected
[[nodiscard]] Layout read_layout(const toml::table& table, const std::string& name, const std::string& where);

/// The layout of that name in ./experiments/tables, else in data_folder(); the one of "runs" is always there.
/// @throws InputError  no such table; lists those there are
[[nodiscard]] Layout find_layout(const std::string& name);

/// Names that find_layout() accepts, sorted.
[[nodiscard]] std::vector<std::string> layout_names();

}  // namespace kreisel::core
