// report.cpp - `bench report`: tables here, figures and the page by plots/report.py.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "device/device.hpp"
#include "error.hpp"
#include "experiment/experiment_table.hpp"
#include "experiment/runner.hpp"
#include "record/simulation_record.hpp"
#include "session/build_info.hpp"
#include "table/data_folder.hpp"

extern char** environ;

namespace kreisel::core::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json to_json(const Tables& tables) {
  json columns = json::array(), blocks = json::array();
  for (const Block& block : tables.blocks) {
    const auto& all = block.sheet.columns();
    json rows = json::array();
    for (const auto& row : block.sheet.rows()) {
      json& cells = rows.emplace_back(json::array());
      for (std::size_t c = 0; c < all.size(); ++c)
        if (all[c].shown()) cells.push_back(row[c].text);
    }
    if (columns.empty())
      for (const auto& column : all)
        if (column.shown())
          columns.push_back({{"group", column.group}, {"heading", column.heading}, {"left", column.left}});
    blocks.push_back({{"heading", block.heading}, {"rows", rows}, {"notes", block.notes}});
  }
  return {{"columns", columns}, {"blocks", blocks}, {"legend", tables.legend}, {"csv", to_csv(tables)}};
}

/// A folder that is gone when the program is, with what is in it.
struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / fmt::format("kreisel-report-{}", ::getpid());
  TemporaryFolder() { fs::create_directories(path); }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// Solid and part of each run in motion, for plots/simulate.py: {record: simulation}. What made no part, or
/// one that is stable at no speed, has none.
json simulations_of(const std::vector<RecordedRun>& runs, const fs::path& folder) {
  json made = json::object();
  std::optional<device::Device> device;
  for (const RecordedRun& run : runs) {
    if (!run.has_result()) continue;
    if (run.record->kind == RecordKind::simulation) {
      if (!run.at("part").is_null()) made[run.record->path.string()] = run.record->path.string();
      continue;
    }
    if (!run.at("verified").is_object()) continue;
    const std::string& record = run.record->path.string();
    if (made.contains(record)) continue;
    if (!device) device.emplace();
    const fs::path file = folder / fmt::format("simulation-{}.h5", made.size());
    try {
      write_simulation(file, simulate(subject_of_record(record, *device), {}, *device));
      made[record] = file.string();
    } catch (const InputError&) {
      continue;
    }
  }
  return made;
}

/// Where and when records were made: from the first to the last, by which commits, on which devices and
/// hosts.
json made_of(const std::vector<RecordedRun>& runs) {
  std::set<std::string> dates;
  std::map<std::string, std::set<std::string>> of = {{"commit", {}}, {"device", {}}, {"host", {}}};
  for (const RecordedRun& run : runs) {
    if (!run.record) continue;
    const auto text = [&](const char* name) {
      const json found = run.at(name);
      return found.is_string() ? found.get<std::string>() : "";
    };
    if (std::string date = text("provenance.started"); !date.empty()) dates.insert(std::move(date));
    for (auto& [name, all] : of) {
      const std::string value = text(name == "host" ? "provenance.host" : name.c_str());
      all.insert(value.empty() ? "unknown" : value);
    }
  }
  json made = {{"dates", json::array()}};
  if (!dates.empty()) made["dates"] = {*dates.begin(), *dates.rbegin()};
  for (const auto& [name, all] : of) made[name] = fmt::format("{}", fmt::join(all, ", "));
  return made;
}

/// What the page says of an experiment; null where none of its runs is on record.
/// @param folder  for what figures are drawn of beside the records
json section_of(const Experiment& experiment, const fs::path& results, const fs::path& folder) {
  std::vector<RecordedRun> runs = collect(experiment, results);
  json records = json::array();
  std::unordered_set<std::string> known;
  std::size_t missing = 0;
  for (const RecordedRun& run : runs) {
    const std::string path = run.path().string();
    if (path.empty())
      ++missing;
    else if (known.insert(path).second)
      records.push_back(path);
  }
  if (records.empty()) return nullptr;
  json section;
  section["name"] = experiment.name;
  section["title"] = experiment.title;
  section["about"] = experiment.about;
  section["figures"] = experiment.figures;
  if (std::ranges::find(experiment.figures, "simulate") != experiment.figures.end())
    section["simulations"] = simulations_of(runs, folder / experiment.name);
  section["published"] =
      experiment.published.empty() ? json(nullptr) : json(published_file(experiment.published).string());
  section["records"] = std::move(records);
  section["made"] = made_of(runs);
  section["runs"] = runs.size();
  section["missing"] = missing;
  const Tables tables = tables_of(experiment, runs);
  runs = std::vector<RecordedRun>();  // of a large sweep half of the memory
  section.update(to_json(tables));
  return section;
}

/// Debian's Python has h5py and matplotlib; another one on the PATH may not.
std::string python() {
  if (const char* given = std::getenv("KREISEL_PYTHON"); given && *given) return given;
  std::error_code ignored;
  return fs::exists("/usr/bin/python3", ignored) ? "/usr/bin/python3" : "python3";
}

/// @return  exit status of the script
int call(const fs::path& script, const fs::path& tables, const std::string& output) {
  std::array<std::string, 5> words = {python(), script.string(), tables.string(), "-o", output};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  pid_t child = 0;
  const int error = posix_spawnp(&child, words[0].c_str(), nullptr, nullptr, arguments.data(), environ);
  if (error != 0)
    throw InputError(fmt::format("{}: {}, expected Python 3 with h5py and matplotlib (setup.sh installs it)",
                                 words[0], std::strerror(error)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : was_interrupted;
}

}  // namespace

int report(const ReportOptions& options) {
  require_writable(options.output, "-o");
  const fs::path script = data_folder() / "plots" / "report.py";
  if (!fs::is_regular_file(script))
    throw InputError(fmt::format("{}: no such file, expected the script that draws", script.string()));
  std::vector<std::string> names = options.experiments;
  if (names.empty()) names = experiment_names();
  const TemporaryFolder folder;
  json page = {{"version", build_info::version}, {"commit", build_info::commit}, {"sections", json::array()}};
  for (const std::string& name : names) {
    json section = section_of(read_experiment(find_experiment(name)), options.results, folder.path);
    if (!section.is_null()) page["sections"].push_back(std::move(section));
  }
  if (page["sections"].empty())
    throw InputError(fmt::format("{}: no records of {}, expected those that `bench run` writes",
                                 options.results, fmt::join(names, ", ")));
  const fs::path tables = folder.path / "tables.json";
  write_text(tables, page.dump(-1, ' ', false, json::error_handler_t::replace));
  // The scripts ask the program for values; another one may come first in the path.
  ::setenv("KREISEL_BENCH", fs::read_symlink("/proc/self/exe").c_str(), 1);
  return call(script, tables, options.output);
}

}  // namespace kreisel::core::bench
