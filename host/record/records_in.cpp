#include "record/records_in.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "record/common_fields.hpp"
#include "record/map_record.hpp"
#include "record/nest_record.hpp"
#include "record/schema.hpp"
#include "record/simulation_record.hpp"
#include "record/with_fields.hpp"

namespace kreisel::core {

namespace {

struct Kind {
  RecordKind kind;
  Schema schema;
  nlohmann::json (*summary)(const std::filesystem::path& path);
};

using Path = const std::filesystem::path&;
const Kind kinds[] = {
    {RecordKind::run, run_schema, [](Path path) { return to_json(read_run(path)); }},
    {RecordKind::map, map_schema, [](Path path) { return to_json(read_map(path)); }},
    {RecordKind::nesting, nest_schema, [](Path path) { return to_json(read_nest(path)); }},
    {RecordKind::simulation, simulation_schema, [](Path path) { return to_json(read_simulation(path)); }}};

const Kind& kind_in(const hdf5::File& file, const std::filesystem::path& path) {
  const std::string schema = schema_of(file);
  for (const Kind& kind : kinds)
    if (schema == kind.schema.name) return kind;
  throw InputError(fmt::format("{}: not a record{}; expected one of a run, map, nesting or simulation",
                               path.string(), schema.empty() ? "" : fmt::format(" but a {}", schema)));
}

/// Of a run that failed, whatever its kind: what was asked for, by whom and where.
nlohmann::json summary_of_failure(const hdf5::File& file, const std::filesystem::path& path) {
  return fields::json_with([&](fields::ToJson& json) {
    fields::FromHdf5 from(file, path.string());
    Provenance provenance;
    fields::provenance_fields(from, provenance);
    fields::provenance_fields(json, provenance);
    std::map<std::string, std::string> config;
    from.names("config", "", "config", config);
    json.names("config", "", "config", config);
    for (const char* name : {"model", "problem", "formulation", "solver", "kind", "shapes", "error"})
      if (file.has(name)) json.given(name, file.text(name));
  });
}

}  // namespace

std::map<std::string, std::string> Record::config() const {
  const nlohmann::json config = summary.at("config");
  return config.get<std::map<std::string, std::string>>();
}

RecordKind kind_of_record(const std::filesystem::path& path) {
  return kind_in(hdf5::File::open(path), path).kind;
}

Record read_record(const std::filesystem::path& path) {
  Record record;
  record.path = path;
  const hdf5::File file = hdf5::File::open(path);  // stays open: what is read once is not read again
  const Kind& kind = kind_in(file, path);
  record.kind = kind.kind;
  require_schema(file, path.string(), kind.schema);
  if (file.has("error")) record.error = file.text("error");
  if (!record.error.empty())
    record.summary = summary_of_failure(file, path);
  else if (Summary kept = fields::kept_summary(file); !kept.empty())
    record.summary = std::move(kept);
  else
    record.summary = kind.summary(path);
  return record;
}

Standing standing_of_record(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path);
  const Kind& kind = kind_in(file, path);
  require_schema(file, path.string(), kind.schema);
  Standing standing;
  standing.kind = kind.kind;
  if (file.contains("provenance")) standing.host = file.group("provenance").text("host");
  if (file.has("error"))
    standing.error = file.text("error");
  else if (kind.kind == RecordKind::map)
    standing.complete = file.integer("complete") != 0;
  return standing;
}

Standing standing_of(const Record& record) {
  Standing standing{record.kind, record.error, "", true};
  if (const nlohmann::json host = record.summary.at("provenance.host"); host.is_string())
    standing.host = host.get<std::string>();
  if (record.kind == RecordKind::map && record.error.empty())
    standing.complete = record.summary.at("termination") == "complete";
  return standing;
}

void write_failure(const std::filesystem::path& path, const Run& run, const Provenance& provenance,
                   const std::string& message) {
  const auto schema = [&] {
    if (std::holds_alternative<NestConfig>(run)) return nest_schema;
    if (std::holds_alternative<SimulationRun>(run)) return simulation_schema;
    return run_schema;  // of maps, too: results/README.md
  }();
  fields::write_with(path, [&](fields::ToHdf5& file) {
    fields::schema_fields(file, schema);
    file.names("config", "", "", describe(run));
    fields::provenance_fields(file, provenance);
    if (const Asked* asked = asked_of(run)) {
      file.stored("model", model_text(*asked));
      file.stored("problem", asked->problem);
      file.stored("formulation", asked->formulation);
      file.stored("solver", text_of(run, "solver"));
    }
    if (const auto* nest = std::get_if<NestConfig>(&run)) {
      file.stored("kind", std::string(kind_of(*nest)));
      file.stored("shapes", shapes_text(*nest));
    }
    file.stored("error", message);
  });
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
