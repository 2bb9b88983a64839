#include "table/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "error.hpp"
#include "nearest.hpp"
#include "record/map_record.hpp"
#include "record/nest_record.hpp"
#include "record/record.hpp"
#include "record/simulation_record.hpp"
#include "table/columns.hpp"
#include "table/data_folder.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

/// In the program, for what is run without its data.
constexpr std::string_view runs_layout = R"(
summary = "a row a run"
of      = "solve"
notes   = "failed"
legend  = ["{provenance}", { line = "gap %: f lies no further above the least that any interior of the domain has, certified", when = "gap_percent" }]
columns = [
  { name = "label", left = true }, "model", "grid", { name = "problem", left = true },
  { name = "formulation", left = true }, { name = "solver", left = true }, "variables", "iterations",
  "termination", "seconds", { name = "seconds_half_iqr", heading = "" }, { name = "samples", heading = "" },
  { name = "objective", heading = "objective" }, "violation", "verified", { name = "device", heading = "" },
  { name = "commit", heading = "" }, { name = "error", heading = "" }, { name = "gap_percent", when = "gap_percent" },
]
)";

/// A table of TOML whose keys are asked for one by one; what is left in the end is unknown.
class Keys {
 public:
  Keys(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

  [[noreturn]] void fail(std::string_view key, std::string_view expected) const {
    const toml::node* node = table_.get(key);
    const auto line = (node ? node->source() : table_.source()).begin.line;
    throw InputError(fmt::format("{}: line {}: {}: expected {}", where_, line, key, expected));
  }

  void text(const char* key, std::string& into) {
    if (const toml::node* node = take(key)) {
      if (const auto value = node->value_exact<std::string>())
        into = *value;
      else
        fail(key, "a string in quotes");
    }
  }
  void flag(const char* key, bool& into) {
    if (const toml::node* node = take(key)) {
      if (const auto value = node->value_exact<bool>())
        into = *value;
      else
        fail(key, "true or false");
    }
  }
  void condition(const char* key, std::optional<Condition>& into) {
    std::string text_of_it;
    text(key, text_of_it);
    if (!text_of_it.empty()) into = Condition{text_of_it};
  }
  /// One string, or a list of them.
  void texts(const char* key, std::vector<std::string>& into) {
    const toml::node* node = take(key);
    if (!node) return;
    into.clear();
    const auto add = [&](const toml::node& item) {
      const auto value = item.value_exact<std::string>();
      if (!value) fail(key, "strings in quotes");
      into.push_back(*value);
    };
    if (const toml::array* list = node->as_array())
      for (const toml::node& item : *list) add(item);
    else
      add(*node);
  }
  void conditions(const char* key, std::vector<Condition>& into) {
    std::vector<std::string> all;
    texts(key, all);
    for (std::string& one : all) into.push_back({std::move(one)});
  }
  const toml::array* list(const char* key) {
    const toml::node* node = take(key);
    if (node && !node->is_array()) fail(key, "a list");
    return node ? node->as_array() : nullptr;
  }
  void end() const {
    for (auto&& [key, node] : table_) {
      if (asked_.contains(std::string(key.str()))) continue;
      const std::vector<std::string> names(asked_.begin(), asked_.end());
      throw InputError(fmt::format("{}: line {}: {}", where_, key.source().begin.line,
                                   unknown_name("key", key.str(), names).what()));
    }
  }

 private:
  const toml::node* take(const char* key) {
    asked_.insert(key);
    return table_.get(key);
  }

  const toml::table& table_;
  std::string where_;
  std::set<std::string> asked_;
};

void require_format(const std::string& format, const std::string& where) {
  try {
    (void)fmt::format(fmt::runtime("{:" + format + "}"), 1.0);
  } catch (const fmt::format_error&) {
    throw InputError(
        fmt::format("{}: format = \"{}\"; expected one of a number, such as \".3f\"", where, format));
  }
}

/// Names at the top of a summary of any kind: those of an empty result.
const std::set<std::string>& summary_names() {
  static const std::set<std::string> all = [] {
    RunResult run;
    run.certificate.emplace();
    run.outcome.local_minimum.emplace();
    NestResult nest;
    nest.accuracy.emplace();
    nest.layers.emplace();
    nest.timings.push_back({"hybrid"});
    nest.trace.emplace_back();
    NestResult outlines;
    outlines.config.kind = NestOutlines();
    outlines.landscape.emplace().map = {.nx = 1, .ny = 1, .scale = {0}, .rotation = {0}};
    Simulation simulation;
    simulation.termination = "optimal";
    simulation.part.spin.emplace();
    std::set<std::string> names = {"provenance", "paper", "heading", "label", "shapes", "trace"};
    for (const nlohmann::json& summary :
         {to_json(run), to_json(nest), to_json(outlines), to_json(simulation), to_json(OrientationMap{})})
      for (const auto& [name, value] : summary.items()) names.insert(name);
    return names;
  }();
  return all;
}

/// A name that nothing has would be an empty column. @param operand  as it stands in an expression
void require_known(std::string_view operand, const std::string& where) {
  std::string_view name = operand.substr(0, operand.find('['));
  for (const std::string_view prefix : {"converged.", "asked."})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  if (name.starts_with("item.") || name.starts_with("published.") || find_column(name) || is_field(name))
    return;
  const std::string first(name.substr(0, name.find('.')));
  if (summary_names().contains(first) || is_field(first)) return;
  std::vector<std::string_view> names(summary_names().begin(), summary_names().end());
  for (const Column& column : columns()) names.push_back(column.name);
  const std::string meant = nearest(name, names);
  throw InputError(fmt::format("{}: '{}' is no column, field or part of a record; expected one{}", where,
                               name, meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant)));
}

/// What a column has by the name of its value: a heading, a format, a side.
void complete(LayoutColumn& column, bool headed) {
  const Column* known = find_column(column.value.substr(0, column.value.find('[')));
  if (known) column.left = column.left || known->left;
  if (known && column.format.empty()) column.format = known->format;
  if (headed) return;
  column.heading = known ? std::string(known->heading) : column.name;
  if (!known) std::ranges::replace(column.heading, '_', ' ');
}

LayoutColumn read_column(const toml::node& node, const std::string& where) {
  LayoutColumn column;
  bool headed = false;
  if (const auto name = node.value_exact<std::string>()) {
    column.name = column.value = *name;
  } else if (const toml::table* table = node.as_table()) {
    Keys keys(*table, where);
    headed = table->contains("heading");
    keys.text("name", column.name);
    keys.text("value", column.value);
    keys.text("group", column.group);
    keys.text("heading", column.heading);
    keys.text("format", column.format);
    keys.text("join", column.join);
    keys.text("paper", column.paper);
    keys.flag("left", column.left);
    keys.flag("once", column.once);
    keys.conditions("when", column.when);
    keys.conditions("hidden_when", column.hidden_when);
    keys.condition("blank_when", column.blank_when);
    keys.condition("parentheses_when", column.parentheses_when);
    keys.end();
    if (column.value.empty()) column.value = column.name;
    if (column.value.empty()) keys.fail("name", "a column with a name or a value");
  } else {
    throw InputError(fmt::format(
        "{}: line {}: a column that is neither; expected a name in quotes or {{ name = ..., ... }}", where,
        node.source().begin.line));
  }
  const std::string at = fmt::format("{}: line {}", where, node.source().begin.line);
  require_format(column.format, at);
  try {
    if (column.value.find('{') == std::string::npos)
      for (const std::string& name : names_in(column.value)) require_known(name, at);
    else
      (void)text_of(Row{}, column.value);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(at)) throw;
    throw InputError(fmt::format("{}: {}", at, error.what()));
  }
  complete(column, headed);
  return column;
}

std::vector<LayoutLine> read_legend(const toml::array& list, const std::string& where) {
  std::vector<LayoutLine> lines;
  for (const toml::node& node : list) {
    LayoutLine& line = lines.emplace_back();
    if (const auto text = node.value_exact<std::string>()) {
      line.pattern = *text;
      continue;
    }
    if (!node.is_table())
      throw InputError(
          fmt::format("{}: line {}: a line of the legend; expected text or {{ line = ..., when = ... }}",
                      where, node.source().begin.line));
    Keys keys(*node.as_table(), where);
    keys.text("line", line.pattern);
    keys.conditions("when", line.when);
    keys.end();
  }
  return lines;
}

fs::path file_of(const std::string& name) {
  std::vector<fs::path> folders = {fs::path("experiments") / "tables"};
  try {
    folders.push_back(data_folder() / "experiments" / "tables");
  } catch (const InputError&) {
    // Without data there are those here, and that of runs.
  }
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (const fs::path file = folder / (name + ".toml"); fs::is_regular_file(file, ignored)) return file;
  return {};
}

}  // namespace

Layout read_layout(const toml::table& table, const std::string& name, const std::string& where) {
  Layout layout;
  layout.name = name;
  Keys keys(table, where);
  keys.text("summary", layout.summary);
  keys.text("of", layout.of);
  keys.texts("rows", layout.rows);
  if (layout.rows == std::vector<std::string>{"run"}) layout.rows.clear();
  keys.texts("groups", layout.groups);
  keys.text("each", layout.each);
  keys.condition("only", layout.only);
  keys.texts("heading", layout.heading);
  keys.texts("footer", layout.footer);
  keys.text("note", layout.note);
  keys.flag("as_published", layout.as_published);
  keys.text("paper_rows", layout.paper_rows);
  keys.text("paper_rows_in", layout.paper_rows_in);
  std::string notes = "unless optimal";
  keys.text("notes", notes);
  const std::vector<std::string> all = {"unless optimal", "failed", "missing"};
  const auto kind = std::ranges::find(all, notes);
  if (kind == all.end()) keys.fail("notes", "\"unless optimal\", \"failed\" or \"missing\"");
  layout.notes = static_cast<Layout::Notes>(kind - all.begin());
  if (const toml::array* legend = keys.list("legend")) layout.legend = read_legend(*legend, where);
  if (const toml::array* list = keys.list("columns"))
    for (const toml::node& node : *list) layout.columns.push_back(read_column(node, where));
  if (layout.columns.empty()) keys.fail("columns", "at least one");
  keys.end();
  return layout;
}

Layout find_layout(const std::string& name) {
  if (const fs::path file = file_of(name); !file.empty()) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(fmt::format("{}: cannot be opened, expected a table", file.string()));
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return read_layout(parse_toml(text, file.string()), name, file.string());
  }
  if (name == "runs") return read_layout(parse_toml(runs_layout, name), name, "the table of runs");
  throw unknown_name("table", name, layout_names());
}

std::vector<std::string> layout_names() {
  std::set<std::string> names = {"runs"};
  std::vector<fs::path> folders = {fs::path("experiments") / "tables"};
  try {
    folders.push_back(data_folder() / "experiments" / "tables");
  } catch (const InputError&) {
  }
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  }
  return {names.begin(), names.end()};
}

}  // namespace kreisel::core
