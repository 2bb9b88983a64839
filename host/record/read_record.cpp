#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "error.hpp"
#include "record/hdf5_file.hpp"
#include "record/record.hpp"
#include "record/schema.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;

std::vector<Seconds> seconds_of(const Group& group, const std::string& dataset, const std::string& name) {
  const auto table = group.read(dataset);
  if (table.shape.columns != 4)
    throw InputError(fmt::format("{}: {} has {} columns, expected setup, kernels, solve, total", name,
                                 dataset, table.shape.columns));
  std::vector<Seconds> rows;
  for (std::size_t r = 0; r < table.shape.rows; ++r) {
    const double* row = table.values.data() + 4 * r;
    rows.push_back({row[0], row[1], row[2], row[3]});
  }
  return rows;
}

Moments moments_of(const Group& group, const std::string& dataset, const std::string& name) {
  const auto table = group.read(dataset);
  if (table.values.size() != moment_names.size())
    throw InputError(fmt::format("{}: {} has {} numbers, expected {}", name, dataset, table.values.size(),
                                 moment_names.size()));
  return Eigen::Map<const Moments>(table.values.data());
}

void read_domain(const Group& group, RecordSummary& summary, const std::string& name) {
  const auto grid = group.read_integers("grid");
  if (grid.values.size() != 3)
    throw InputError(fmt::format("{}: grid has {} numbers, expected 3", name, grid.values.size()));
  std::ranges::copy(grid.values, summary.grid.begin());
  summary.domain = group.text("kind");
  summary.rays = static_cast<std::size_t>(group.integer("rays"));
  summary.interior_voxels = static_cast<std::size_t>(group.integer("interior_voxels"));
}

void read_certificate(const Group& group, RecordSummary& summary) {
  summary.certificate_kind = group.text("kind");
  summary.certificate_boxes = static_cast<int>(group.integer("searches"));
  summary.certificate_seconds = group.real("seconds");
}

void read_solve(const Group& group, RecordSummary& summary, const std::string& name) {
  summary.message = group.text("message");
  // Early records of this schema have neither these nor moved_voxels.
  if (group.has("scope")) summary.scope = group.text("scope");
  if (group.has("infeasibility")) summary.infeasibility = group.text("infeasibility");
  if (group.has("strict_local_minimum")) {
    summary.strict_minimum = group.text("strict_local_minimum");
    summary.smallest_eigenvalue = group.real("smallest_eigenvalue");
  }
  summary.evaluations =
      static_cast<int>(group.integer("evaluations_objective") + group.integer("evaluations_hessian"));
  if (group.contains("refinements")) {
    const auto rounds = group.read("refinements");
    summary.rounds = rounds.shape.rows;
    constexpr std::size_t along = 4;
    if (rounds.shape.columns <= along || rounds.shape.rows == 0)
      throw InputError(fmt::format("{}: refinements of {} x {} numbers, expected 11 columns", name,
                                   rounds.shape.rows, rounds.shape.columns));
    summary.along_voids =
        static_cast<std::size_t>(rounds.values[(rounds.shape.rows - 1) * rounds.shape.columns + along]);
  }
  summary.repeat = static_cast<int>(group.integer("repeat"));
  summary.budget_seconds = group.real("budget");
  summary.samples = seconds_of(group, "samples", name);
  const auto median = seconds_of(group, "median", name);
  if (median.size() != 1)
    throw InputError(fmt::format("{}: median has {} rows, expected 1", name, median.size()));
  summary.median = median.front();
}

void read_part(const hdf5::File& file, RecordSummary& summary, const std::string& name) {
  const Group rounding = file.group("rounding");
  summary.rounded_objective = rounding.real("objective");
  summary.rounded_violation = rounding.real("violation");
  summary.mended_voxels = static_cast<std::size_t>(rounding.integer("mended_voxels"));
  if (rounding.has("moved_voxels"))
    summary.moved_voxels = static_cast<std::size_t>(rounding.integer("moved_voxels"));
  const Group verified = file.group("verified");
  if (verified.has("voids")) {  // early records have none of these
    summary.voids = static_cast<std::size_t>(verified.integer("voids"));
    summary.islands = static_cast<std::size_t>(verified.integer("islands"));
    summary.cuts = static_cast<std::size_t>(verified.integer("cuts"));
    const std::vector<double> volumes = file.group("voids").read("pieces").values;
    summary.voids_mm3 = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    summary.largest_void_mm3 = volumes.empty() ? 0 : volumes.front();
  }
  summary.written = moments_of(verified, "moments", name);
  summary.verified_ok = verified.integer("ok") != 0;
  summary.verified_text = verified.text("text");
  const Group values = verified.group("values");
  for (const std::string& value : values.attributes()) summary.verified_values[value] = values.real(value);
}

}  // namespace

RecordSummary read_record(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path);
  const std::string name = path.string();
  require_schema(file, name, "a record of a run", run_schema, record_schema_version);

  RecordSummary summary;
  summary.path = path;
  const Group config = file.group("config");
  for (const std::string& key : config.attributes()) summary.config[key] = config.text(key);
  const Group provenance = file.group("provenance");
  summary.commit = provenance.text("commit");
  summary.device = provenance.text("device");
  summary.started = provenance.text("started");
  if (provenance.has("load")) summary.load = provenance.real("load");
  summary.model = file.text("model");
  summary.problem = file.text("problem");
  summary.formulation = file.text("formulation");
  summary.solver = file.text("solver");
  if (file.has("error")) {
    summary.error = file.text("error");
    return summary;
  }

  summary.termination = file.text("termination");
  summary.objective = file.real("objective");
  summary.violation = file.real("constraint_violation");
  if (file.has("bound")) summary.bound = file.real("bound");
  if (file.has("gap")) summary.gap = file.real("gap");
  if (file.has("bound")) read_certificate(file.group("certificate"), summary);
  summary.iterations = static_cast<int>(file.integer("iterations"));
  summary.variables = static_cast<std::size_t>(file.integer("variables"));
  if (file.has("whole_seconds")) summary.whole_seconds = file.real("whole_seconds");
  if (file.has("peak_bytes")) summary.peak_bytes = file.real("peak_bytes");
  read_domain(file.group("domain"), summary, name);
  const Group body = file.group("body");
  summary.length_mm = body.real("length");
  summary.mass_unit_grams = body.real("mass_unit");
  summary.solid_objective = body.real("solid_objective");
  summary.solid = moments_of(body, "solid", name);
  read_solve(file.group("solve"), summary, name);
  summary.optimum = moments_of(file.group("solve"), "moments", name);
  summary.has_part = !file.has("no_part");
  if (summary.has_part)
    read_part(file, summary, name);
  else
    summary.verified_text = file.text("no_part");
  return summary;
}

}  // namespace kreisel::core
