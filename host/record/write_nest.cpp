#include <array>
#include <cmath>
#include <limits>

#include "record/common_groups.hpp"
#include "record/hdf5_file.hpp"
#include "record/nest_groups.hpp"
#include "record/nest_record.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;

void write_placement(Group group, const NestResult& result) {
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> transform = result.transform;
  group.write("transform", {transform.data(), 12}, {3, 4},
              {"1, 1, 1, outer units", {"x", "y", "z", "shift"}});
  write_vector(group, "plane_point", result.plane_point, "outer units");
  write_vector(group, "plane_normal", result.plane_normal, "1");
  write_vector(group, "removal_plus", result.plus, "1");
  write_vector(group, "removal_minus", result.minus, "1");
}

void write_trace(Group& file, const NestResult& result) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < result.trace.size(); ++i) {
    const nest::SwarmStep& step = result.trace[i];
    rows.insert(rows.end(), {double(step.iteration), double(step.evaluations), step.best, step.mean,
                             step.feasible, i < result.trace_seconds.size() ? result.trace_seconds[i] : nan});
  }
  file.write("trace", rows, {result.trace.size(), 6},
             {"1, 1, 1, 1, 1, s", {"iteration", "evaluations", "best", "mean", "feasible", "seconds"}});
}

void write_timings(Group group, const std::vector<NestTiming>& timings) {
  for (const NestTiming& timing : timings) {
    const std::array row = {timing.test_ms, timing.search_ms, timing.scale};
    group.write(timing.variant, row, {row.size()}, {"ms, ms, 1", {"test", "search", "scale"}});
  }
}

void write_accuracy(Group group, const nest::Accuracy& accuracy) {
  group.set("placements", accuracy.placements);
  group.set("nested", accuracy.nested);
  group.set("exact_agrees", accuracy.exact_agrees);
  group.set("peel_disagrees", accuracy.peel_disagrees);
  group.set("pixels", accuracy.pixels);
  std::vector<double> rows;
  for (const nest::SampledError& e : accuracy.errors)
    rows.insert(rows.end(), {double(e.resolution), double(e.optimistic), double(e.pessimistic),
                             double(e.missed), e.median, e.most_of, e.largest});
  group.write(
      "errors", rows, {accuracy.errors.size(), 7},
      {"1", {"resolution", "optimistic", "pessimistic", "missed", "median", "percentile_95", "largest"}});
}

void write_asked(hdf5::File& file, const NestConfig& config, const Provenance& provenance) {
  file.set("schema", "kreisel nesting");
  file.set("schema_version", nest_schema_version);
  file.set("kind", kind_of(config));
  file.set("shapes", shapes_text(config));
  Group group = file.new_group("config");
  for (const auto& [key, value] : describe(config)) group.set(key, value);
  write_provenance(file.new_group("provenance"), provenance);
}

}  // namespace

void write_nest(const std::filesystem::path& path, const NestResult& result) {
  hdf5::File file = hdf5::File::create(path);
  write_asked(file, result.config, result.provenance);
  file.set("outer", result.config.outer);
  file.set("inner", result.config.inner.empty() ? result.config.outer : result.config.inner);
  file.set("seed", static_cast<std::int64_t>(seed_of(result.config)));
  file.set("outer_triangles", result.outer_triangles);
  file.set("inner_triangles", result.inner_triangles);
  file.set("termination", termination_of(result));
  file.set("text", result.text);
  file.set("valid", result.valid);
  file.set("evaluations", static_cast<std::int64_t>(result.evaluations));
  file.set("scale", result.placed ? result.scale : nan);
  file.set("confirmed", result.certified && result.certified->confirmed);
  file.set("certified_scale",
           result.certified && result.certified->scale > 0 ? result.certified->scale : nan);
  file.set("sampled_scale", result.sampled_scale.value_or(nan));
  file.set("setup_seconds", result.setup_seconds);
  file.set("search_seconds", result.search_seconds);
  file.set("certify_seconds", result.certify_seconds);
  if (result.placed) write_placement(file.new_group("placement"), result);
  if (!result.trace.empty()) write_trace(file, result);
  if (!result.timings.empty()) write_timings(file.new_group("timings"), result.timings);
  if (result.accuracy) write_accuracy(file.new_group("accuracy"), *result.accuracy);
  if (result.layers) write_layers(file.new_group("layers"), *result.layers);
  if (result.landscape) write_landscape(file.new_group("landscape"), result);
  if (!result.shapes.empty()) write_shapes(file.new_group("shapes"), result.shapes);
  file.close();
}

void write_nest_failure(const std::filesystem::path& path, const NestConfig& config,
                        const Provenance& provenance, const std::string& message) {
  hdf5::File file = hdf5::File::create(path);
  write_asked(file, config, provenance);
  file.set("error", message);
  file.close();
}

}  // namespace kreisel::core
