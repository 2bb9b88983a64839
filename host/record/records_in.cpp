#include "record/records_in.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "record/map_record.hpp"
#include "record/nest_record.hpp"
#include "record/schema.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {

namespace {

RecordKind kind_in(const hdf5::File& file, const std::filesystem::path& path) {
  const std::string schema = schema_of(file);
  if (schema == run_schema) return RecordKind::run;
  if (schema == map_schema) return RecordKind::map;
  if (schema == nest_schema) return RecordKind::nesting;
  if (schema == simulation_schema) return RecordKind::simulation;
  throw InputError(fmt::format("{}: not a record{}; expected one of a run, map, nesting or simulation",
                               path.string(), schema.empty() ? "" : fmt::format(" but a {}", schema)));
}

nlohmann::json summary_of(RecordKind kind, bool failed, const std::filesystem::path& path) {
  switch (kind) {
    case RecordKind::run:
      return failed ? asked_json(read_run(path)) : to_json(read_run(path));
    case RecordKind::map:
      return to_json(read_map(path));
    case RecordKind::nesting:
      return failed ? asked_json(read_nest(path)) : to_json(read_nest(path));
    case RecordKind::simulation:
      break;
  }
  return to_json(read_simulation(path));
}

}  // namespace

std::map<std::string, std::string> Record::config() const {
  return summary.at("config").get<std::map<std::string, std::string>>();
}

RecordKind kind_of_record(const std::filesystem::path& path) { return kind_in(hdf5::File::open(path), path); }

Record read_record(const std::filesystem::path& path) {
  Record record;
  record.path = path;
  {
    const hdf5::File file = hdf5::File::open(path);
    record.kind = kind_in(file, path);
    if (file.has("error")) record.error = file.text("error");
  }
  record.summary = summary_of(record.kind, !record.error.empty(), path);
  if (!record.error.empty()) record.summary["error"] = record.error;
  return record;
}

std::vector<std::filesystem::path> records_in(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("{}: no such file or folder; expected records", path.string()));
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
    if (entry.path().extension() == ".h5") found.push_back(entry.path());
  if (found.empty()) throw InputError(fmt::format("{}: no records (*.h5) in it", path.string()));
  std::ranges::sort(found);
  return found;
}

}  // namespace kreisel::core
