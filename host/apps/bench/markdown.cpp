// markdown.cpp - `bench report --markdown`: the tables of Markdown files, from records.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "apps/bench/commands.hpp"
#include "error.hpp"
#include "experiment/experiment_table.hpp"
#include "experiment/runner.hpp"
#include "experiment/table_places.hpp"
#include "file/write_text.hpp"

namespace kreisel::core::bench {
namespace {

namespace fs = std::filesystem;

/// The tables of experiments, each made once.
class Made {
 public:
  explicit Made(const ReportOptions& options) : options_(options) {}

  /// None where the experiment is not asked for, or nothing is on record for it.
  std::optional<Tables> of(const std::string& name) {
    const auto& asked = options_.experiments;
    if (!asked.empty() && std::ranges::find(asked, name) == asked.end()) return std::nullopt;
    const auto known = made_.find(name);
    return known != made_.end() ? known->second : made_.emplace(name, make(name)).first->second;
  }

 private:
  [[nodiscard]] std::optional<Tables> make(const std::string& name) const {
    const Experiment experiment = read_experiment(find_experiment(name));
    const std::vector<RecordedRun> runs = collect(experiment, options_.results);
    if (std::ranges::all_of(runs, [](const RecordedRun& run) { return run.path().empty(); })) {
      fmt::print("{}: no records in {}, its tables stay as they are\n", name, options_.results);
      return std::nullopt;
    }
    return tables_of(experiment, runs);
  }

  const ReportOptions& options_;
  std::map<std::string, std::optional<Tables>> made_;
};

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
    throw InputError(fmt::format("{}: cannot be read, expected a Markdown file", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

int report_markdown(const ReportOptions& options) {
  Made made(options);
  std::vector<std::pair<fs::path, std::string>> changed;  // nothing is written before all is well
  for (const std::string& file : options.markdown) {
    const std::string before = content_of(file);
    int filled = 0, left = 0;
    const std::string after = fill_places(before, file, [&](const TablePlace& place) {
      try {
        const std::optional<Tables> tables = made.of(place.experiment);
        ++(tables ? filled : left);
        return tables ? std::optional(to_markdown(*tables, place.selection)) : std::nullopt;
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: line {}: {}", file, place.line, error.what()));
      }
    });
    fmt::print("{}: {} tables from records, {} left as they are{}\n", file, filled, left,
               after == before ? "; no change" : "");
    if (after != before) changed.emplace_back(file, after);
  }
  for (const auto& [file, text] : changed) write_text(file, text);
  return done;
}

}  // namespace kreisel::core::bench
