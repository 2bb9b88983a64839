#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "error.hpp"
#include "record/hdf5_file.hpp"
#include "record/map_record.hpp"
#include "record/schema.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (lines.empty()) lines.emplace_back();  // `spin`: one case without a name
  return lines;
}

/// The share of the rows of column c that hold `value`.
double share(const hdf5::Table<int>& table, std::size_t c, int value) {
  const std::size_t rows = table.shape.rows;
  std::size_t n = 0;
  for (std::size_t r = 0; r < rows; ++r) n += table.values[r * table.shape.columns + c] == value;
  return rows ? static_cast<double>(n) / static_cast<double>(rows) : 0;
}

Vec3 row_of(const Group& file, const std::string& name, std::size_t row) {
  const auto table = file.read(name);
  return {table.values.at(3 * row), table.values.at(3 * row + 1), table.values.at(3 * row + 2)};
}

MapSummary::Best read_best(const hdf5::File& file, const MapSummary& map, std::size_t axis,
                           std::size_t at_case) {
  const std::size_t at = axis * map.cases.size() + at_case;
  MapSummary::Best best;
  best.axis = row_of(file, "axes", axis);
  best.contact = row_of(file, "contacts", axis);
  best.draft = map.cases.at(at_case).draft;
  best.command = file.text("best_command");
  best.ok = file.read_integers("ok").values.at(at) == 1;
  best.objective = file.read("objective").values.at(at);
  const Group values = file.group("values");
  for (const char* name : {"omega_min_rpm", "metacentric_height_mm"})
    best.values[name] =
        values.contains(name) ? values.read(name).values.at(at) : std::numeric_limits<double>::quiet_NaN();
  return best;
}

}  // namespace

bool is_map(const std::filesystem::path& path) { return schema_of(hdf5::File::open(path)) == map_schema; }

MapSummary read_map(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path);
  const std::string name = path.string();
  require_schema(file, name, "a map", map_schema, map_schema_version);
  MapSummary map;
  map.path = path;
  map.model = file.text("model");
  map.problem = file.text("problem");
  map.through = file.text("through");
  map.asked = static_cast<std::size_t>(file.integer("axes_asked"));
  map.setup_seconds = file.real("setup_seconds");
  map.sweep_seconds = file.real("sweep_seconds");
  const Group provenance = file.group("provenance");
  map.commit = provenance.text("commit");
  map.device = provenance.text("device");
  map.started = provenance.text("started");
  if (provenance.has("load")) map.load = provenance.real("load");
  const Group domain = file.group("domain");
  map.rays = static_cast<std::size_t>(domain.integer("rays"));
  const auto grid = domain.read_integers("grid");
  if (grid.values.size() != 3)
    throw InputError(fmt::format("{}: grid has {} numbers, expected 3", name, grid.values.size()));
  std::ranges::copy(grid.values, map.grid.begin());

  const auto feasible = file.read_integers("feasible"), ok = file.read_integers("ok");
  const std::vector<std::string> drafts = lines_of(file.text("cases"));
  if (feasible.shape.columns != drafts.size() || ok.shape != feasible.shape)
    throw InputError(fmt::format("{}: feasible has {} columns, expected {}, one a case", name,
                                 feasible.shape.columns, drafts.size()));
  map.axes = feasible.shape.rows;
  for (std::size_t c = 0; c < drafts.size(); ++c)
    map.cases.push_back({drafts[c], share(feasible, c, 1), share(feasible, c, -1), share(ok, c, 1)});
  const std::int64_t axis = file.integer("best_axis"), at_case = file.integer("best_case");
  if (axis >= 0 && at_case >= 0)
    map.best = read_best(file, map, static_cast<std::size_t>(axis), static_cast<std::size_t>(at_case));
  return map;
}

}  // namespace kreisel::core
