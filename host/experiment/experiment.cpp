#include "experiment/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <utility>

#include "error.hpp"
#include "nearest.hpp"
#include "problem/problem.hpp"
#include "table/data_folder.hpp"
#include "table/layout.hpp"
#include "table/table_kinds.hpp"
#include "toml.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;
namespace {

struct Value {
  std::string text;
  unsigned line;
};

/// `key = value` of a table, its value a list of one or more.
struct Assignment {
  std::string key;
  std::vector<Value> values;
  toml::source_position at;
};

/// A run before its lists are multiplied out.
struct RunTable {
  std::string label, kind;  ///< no kind: as its fields say
  bool mesh = false;
};

/// What an experiment or a run may say that is no field.
constexpr std::array<std::string_view, 9> other_keys = {"title", "table", "published", "figures", "run",
                                                        "label", "mesh",  "kind",      "set"};

/// The lines of the comment that the text begins with, without "# ".
std::string opening_comment(std::string_view text) {
  std::string comment;
  while (text.starts_with('#')) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::size_t skip = text.substr(0, end).starts_with("# ") ? 2 : 1;
    comment.append(text.substr(skip, end - skip)).append("\n");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return comment;
}

class Parser {
 public:
  Parser(std::string_view text, const fs::path& file) : file_(file.string()) {
    experiment_.name = experiment_.title = file.stem().string();
    experiment_.about = opening_comment(text);
    root_ = parse_toml(text, file_);
  }

  Experiment parse() {
    const toml::array* runs = nullptr;
    if (const toml::node* table = root_.get("table")) read_table(*table, table->source().begin.line);
    of_ = experiment_.layout ? experiment_.layout->of : kind_set_out_by(experiment_.table);
    nestings_ = of_ == "nesting";
    RunTable defaults;
    std::vector<Assignment> common;
    for (auto&& [key, node] : root_) {
      const unsigned line = key.source().begin.line;
      if (key == "title") {
        experiment_.title = string_of(key.str(), node, line);
      } else if (key == "published") {
        experiment_.published = string_of(key.str(), node, line);
      } else if (key == "table") {
        continue;  // says what the other keys are, and so came first
      } else if (key == "figures") {
        experiment_.figures = figures_of(node, line);
      } else if (key == "run") {
        runs = node.as_array();
        if (!runs || !runs->is_homogeneous(toml::node_type::table))
          fail(line, "'run' is not a table of its own, expected [[run]]");
      } else {
        read(key, node, defaults, common);
      }
    }
    if (!runs) fail(root_.source().end.line, "no run, expected at least one [[run]] table");
    for (const toml::node& table : *runs) {
      RunTable run = defaults;
      std::vector<Assignment> own;
      for (auto&& [key, node] : *table.as_table()) read(key, node, run, own);
      multiply_out(run, merged(common, own));
    }
    require_one_kind();
    return std::move(experiment_);
  }

 private:
  [[noreturn]] void fail(unsigned line, const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, line, what));
  }

  /// Tables and figures set out runs of one kind, or nestings of any.
  void require_one_kind() const {
    const unsigned line = root_.source().end.line;
    for (const ExperimentRun& run : experiment_.runs) {
      const RunKind& kind = run_kind_of(run.run);
      const bool nesting = std::holds_alternative<NestConfig>(*run.run);
      if (!of_.empty() && (nesting ? "nesting" : kind.name) != of_) {
        if (of_ == "map")
          fail(line, "table = \"maps\" with a run that is none, expected axes or through in every run");
        fail(line, fmt::format("table = \"{}\" with {}, expected a {} in every run{}", experiment_.table,
                               kind.what, of_, kind.name == "map" ? ", or table = \"maps\"" : ""));
      }
      const auto* solve = std::get_if<RunConfig>(&*run.run);
      if (run.mesh && (!solve || solve->part == Part::none))
        fail(line, "mesh = true for a run that makes no part, expected a solve with part = \"written\"");
      if (run.mesh && solve->limits.any())
        fail(line, "memory or seconds with mesh = true, expected a solve that keeps no mesh");
    }
  }

  std::string string_of(std::string_view key, const toml::node& node, unsigned line) const {
    const auto value = node.value_exact<std::string>();
    if (!value) fail(line, fmt::format("{} is not text, expected a string in quotes", key));
    return *value;
  }

  /// `table = "NAME"`, or [table] with a layout of its own.
  void read_table(const toml::node& node, unsigned line) {
    try {
      if (const toml::table* own = node.as_table()) {
        experiment_.table = "of its own";
        experiment_.layout = std::make_shared<const Layout>(read_layout(*own, experiment_.name, file_));
      } else {
        experiment_.table = string_of("table", node, line);
        (void)kind_set_out_by(experiment_.table);
      }
    } catch (const InputError& error) {
      if (std::string_view(error.what()).starts_with(file_)) throw;
      fail(line, error.what());
    }
  }

  /// Stems of scripts; whether there are such scripts is seen when they are called.
  std::vector<std::string> figures_of(const toml::node& node, unsigned line) const {
    const toml::array* list = node.as_array();
    if (!list) fail(line, "figures is not a list, expected names of scripts in quotes");
    std::vector<std::string> names;
    for (const toml::node& item : *list)
      names.push_back(string_of("a name among figures", item, item.source().begin.line));
    return names;
  }

  /// One key of the top level or of a run.
  void read(const toml::key& key, const toml::node& node, RunTable& run,
            std::vector<Assignment>& into) const {
    const toml::source_position at = key.source().begin;
    if (key == "label") {
      run.label = string_of("label", node, at.line);
    } else if (key == "kind") {
      run.kind = kind_of(node, at.line);
    } else if (key == "mesh") {
      const auto value = node.value_exact<bool>();
      if (!value) fail(at.line, "mesh is not a boolean, expected true or false");
      run.mesh = *value;
    } else if (key == "set") {
      if (!node.is_table()) fail(at.line, "'set' is not a table, expected set.GROUP.NAME = value");
      flatten("", *node.as_table(), into);
    } else if (key.str().find('.') != std::string_view::npos) {
      fail(at.line, fmt::format("setting '{}' outside 'set', expected set.{}", key.str(), key.str()));
    } else {
      require_known(key.str(), at.line);
      into.push_back({std::string(key.str()), values_of(key.str(), node, at.line), at});
    }
  }

  std::string kind_of(const toml::node& node, unsigned line) const {
    const std::string name = string_of("kind", node, line);
    try {
      return std::string(find_run_kind(name).name);
    } catch (const InputError& error) {
      fail(line, error.what());
    }
  }

  void require_known(std::string_view key, unsigned line) const {
    if (is_field(key)) return;
    std::string setting(key);
    std::ranges::replace(setting, '-', '_');  // as the option of that name is written
    for (const ProblemEntry& problem : problems())
      if (find_field(problem.settings.fields(), setting))
        fail(line, fmt::format("setting '{}' outside 'set', expected set.problem.{}", key, setting));
    std::vector<std::string_view> names(other_keys.begin(), other_keys.end());
    const auto fields = field_names();  // settings stand under 'set'
    names.insert(names.end(), fields.begin(), fields.end());
    fail(line, unknown_name("key", key, names).what());
  }

  /// [run.set]: nested tables and dotted names mean the same.
  void flatten(const std::string& prefix, const toml::table& table, std::vector<Assignment>& into) const {
    for (auto&& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const toml::source_position at = key.source().begin;
      if (const toml::table* inner = node.as_table()) {
        flatten(name + '.', *inner, into);
      } else if (name.find('.') == std::string::npos) {
        fail(at.line, fmt::format("setting '{}' without a group, expected set.GROUP.NAME = value", name));
      } else {
        into.push_back({name, values_of(name, node, at.line), at});
      }
    }
  }

  std::vector<Value> values_of(std::string_view key, const toml::node& node, unsigned line) const {
    const toml::array* list = node.as_array();
    if (!list) return {{text_of(key, node, line), line}};
    if (list->empty()) fail(line, fmt::format("{} is an empty list, expected at least one value", key));
    std::vector<Value> values;
    for (const toml::node& item : *list) {
      const unsigned at = item.source().begin.line;
      values.push_back({text_of(key, item, at), at});
    }
    return values;
  }

  std::string text_of(std::string_view key, const toml::node& node, unsigned line) const {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
    if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
    if (const auto* yes = node.as_boolean()) return yes->get() ? "yes" : "no";  // as Ipopt writes its flags
    fail(line,
         fmt::format("{} is a table, list of lists or date, expected a string, number or boolean", key));
  }

  /// What a run says replaces the default of that key. In the order of the file: toml++ sorts by name.
  static std::vector<Assignment> merged(const std::vector<Assignment>& common,
                                        const std::vector<Assignment>& own) {
    std::vector<Assignment> all = own;
    for (const Assignment& candidate : common)
      if (std::none_of(own.begin(), own.end(), [&](const auto& mine) { return mine.key == candidate.key; }))
        all.push_back(candidate);
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return std::pair(a.at.line, a.at.column) < std::pair(b.at.line, b.at.column);
    });
    return all;
  }

  /// Counts through the lists like an odometer, the last one fastest.
  void multiply_out(const RunTable& table, const std::vector<Assignment>& assignments) {
    std::vector<std::string_view> names;
    for (const Assignment& assignment : assignments) names.push_back(assignment.key);
    const RunKind& kind = table.kind.empty() ? kind_of_fields(names, nestings_) : find_run_kind(table.kind);
    std::vector<std::size_t> choice(assignments.size(), 0);
    while (true) {
      std::vector<GivenText> given;
      for (std::size_t i = 0; i < assignments.size(); ++i) {
        const Value& value = assignments[i].values[choice[i]];
        given.push_back({assignments[i].key, value.text, fmt::format("{}: line {}: ", file_, value.line)});
      }
      ExperimentRun run{make_run(given, kind), table.label, table.mesh};
      require_fit(run.run, assignments);
      experiment_.runs.push_back(std::move(run));
      std::size_t turn = assignments.size();
      while (turn > 0 && ++choice[turn - 1] == assignments[turn - 1].values.size()) choice[--turn] = 0;
      if (turn == 0) return;
    }
  }

  /// @param assignments  of the run, for the line
  void require_fit(const Run& run, const std::vector<Assignment>& assignments) const {
    try {
      require_valid(run);
    } catch (const InputError& error) {
      fail(assignments.empty() ? root_.source().end.line : assignments.back().at.line, error.what());
    }
  }

  std::string file_;
  toml::table root_;
  std::string of_;         ///< the kind of run that its table sets out; empty: any
  bool nestings_ = false;  ///< its runs are
  Experiment experiment_;
};

/// The file as given, with ".toml" added to a bare name.
std::string with_extension(const std::string& name) {
  return name.ends_with(".toml") ? name : name + ".toml";
}

/// Folders with experiments, nearest first. Without a data folder only those here are found.
std::vector<fs::path> experiment_folders() {
  std::vector<fs::path> folders{"experiments"};
  try {
    folders.push_back(data_folder() / "experiments");
  } catch (const InputError&) {
    // find_experiment() tells when it finds nothing here either.
  }
  return folders;
}

}  // namespace

Experiment parse_experiment(std::string_view text, const fs::path& file) {
  return Parser(text, file).parse();
}

Experiment read_experiment(const fs::path& file) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!fs::is_regular_file(file, ignored) || !stream)
    throw InputError(fmt::format("{}: cannot be read, expected an experiment in TOML", file.string()));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_experiment(text, file);
}

fs::path find_experiment(const std::string& name_or_path) {
  std::error_code ignored;
  if (fs::is_regular_file(name_or_path, ignored)) return name_or_path;
  if (!name_or_path.empty() && name_or_path.find('/') == std::string::npos)
    for (const fs::path& folder : experiment_folders())
      if (fs::path file = folder / with_extension(name_or_path); fs::is_regular_file(file, ignored))
        return file;
  (void)data_folder();  // a folder that is missing is the nearer reason: throws
  const auto names = experiment_names();
  const std::string meant = nearest(name_or_path, names);
  throw InputError(fmt::format("experiment '{}': no such file{}, expected a TOML file{}", name_or_path,
                               meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant),
                               names.empty() ? "" : fmt::format(" or one of {}", fmt::join(names, ", "))));
}

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const fs::path& folder : experiment_folders()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace kreisel::core
