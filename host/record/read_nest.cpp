#include <fmt/format.h>

#include <cmath>

#include "error.hpp"
#include "record/hdf5_file.hpp"
#include "record/nest_groups.hpp"
#include "record/nest_record.hpp"
#include "record/schema.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;

std::optional<double> number_or_none(const Group& group, const std::string& name) {
  const double value = group.real(name);
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

hdf5::Table<double> table_of(const Group& group, const std::string& name, std::size_t columns,
                             const std::string& file) {
  hdf5::Table<double> table = group.read(name);
  if (table.shape.columns != columns)
    throw InputError(
        fmt::format("{}: {} has {} columns, expected {}", file, name, table.shape.columns, columns));
  return table;
}

std::vector<NestTiming> timings_of(const Group& group) {
  std::vector<NestTiming> timings;
  for (const char* variant : {"peel", "envelope", "exact", "hybrid"}) {
    if (!group.contains(variant)) continue;
    const auto row = group.read(variant).values;
    timings.push_back({variant, row.at(0), row.at(1), row.at(2)});
  }
  return timings;
}

nest::Accuracy accuracy_of(const Group& group, const std::string& file) {
  nest::Accuracy accuracy;
  accuracy.placements = static_cast<int>(group.integer("placements"));
  accuracy.nested = static_cast<int>(group.integer("nested"));
  accuracy.exact_agrees = static_cast<int>(group.integer("exact_agrees"));
  accuracy.peel_disagrees = static_cast<int>(group.integer("peel_disagrees"));
  accuracy.pixels = group.integer("pixels");
  const auto table = table_of(group, "errors", 7, file);
  for (std::size_t i = 0; i < table.shape.rows; ++i) {
    const double* row = table.values.data() + 7 * i;
    accuracy.errors.push_back({int(row[0]), int(row[1]), int(row[2]), int(row[3]), row[4], row[5], row[6]});
  }
  return accuracy;
}

}  // namespace

NestSummary read_nest(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path);
  const std::string name = path.string();
  require_schema(file, name, "a nesting", nest_schema, nest_schema_version);
  NestSummary nest;
  nest.path = path;
  nest.kind = file.text("kind");
  nest.shapes = file.text("shapes");
  const Group config = file.group("config"), provenance = file.group("provenance");
  for (const std::string& key : config.attributes()) nest.config[key] = config.text(key);
  nest.commit = provenance.text("commit");
  nest.device = provenance.text("device");
  nest.started = provenance.text("started");
  if (provenance.has("load")) nest.load = provenance.real("load");
  if (file.has("error")) {
    nest.error = file.text("error");
    return nest;
  }
  nest.termination = file.text("termination");
  nest.text = file.text("text");
  nest.valid = file.integer("valid") != 0;
  nest.outer_triangles = static_cast<std::size_t>(file.integer("outer_triangles"));
  nest.inner_triangles = static_cast<std::size_t>(file.integer("inner_triangles"));
  nest.evaluations = static_cast<std::size_t>(file.integer("evaluations"));
  nest.scale = file.real("scale");
  nest.certified_scale = number_or_none(file, "certified_scale");
  nest.sampled_scale = number_or_none(file, "sampled_scale");
  nest.setup_seconds = file.real("setup_seconds");
  nest.search_seconds = file.real("search_seconds");
  nest.certify_seconds = file.real("certify_seconds");
  if (file.contains("trace")) {
    const auto table = table_of(file, "trace", 6, name);
    for (std::size_t i = 0; i < table.shape.rows; ++i) {
      const double* row = table.values.data() + 6 * i;
      nest.trace.push_back({row[1], row[2], row[5]});
    }
  }
  if (file.contains("timings")) nest.timings = timings_of(file.group("timings"));
  if (file.contains("accuracy")) nest.accuracy = accuracy_of(file.group("accuracy"), name);
  if (file.contains("layers")) nest.layers = read_layers(file.group("layers"));
  if (file.contains("landscape")) nest.landscape = read_landscape(file.group("landscape"));
  return nest;
}

}  // namespace kreisel::core
