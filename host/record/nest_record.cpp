#include "record/nest_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "record/common_fields.hpp"
#include "record/nest_groups.hpp"
#include "record/schema.hpp"
#include "record/with_fields.hpp"

namespace kreisel::core {
namespace {
namespace of_nest {

using namespace fields;
using nlohmann::json;

constexpr auto timing_columns = [](auto& column, auto& t) {
  column("test", t.test_ms, "test_ms");
  column("search", t.search_ms, "search_ms");
  column("scale", t.scale);
};

constexpr auto error_columns = [](auto& column, auto& e) {
  column("resolution", e.resolution);
  column("optimistic", e.optimistic);
  column("pessimistic", e.pessimistic);
  column("missed", e.missed);
  column("median", e.median);
  column("percentile_95", e.most_of);
  column("largest", e.largest);
};

constexpr auto layer_columns = [](auto& column, auto& layer) {
  column("outer", layer.outer, "outer_shape");
  column("inner", layer.inner, "inner_shape");
  column("scale", layer.scale);
  column.hidden("certified_scale", layer.certified_scale);  // 0: none
  column.given("certified_scale", layer.certified_scale > 0 ? json(layer.certified_scale) : json());
  column("ratio", layer.ratio);
  column("longest", layer.longest, "longest_mm");
  column("thickness", layer.thickness, "thickness_mm");
  column("evaluations", layer.evaluations);
  column("offset_seconds", layer.offset_seconds, "seconds.offset");
  column("search_seconds", layer.search_seconds, "seconds.search");
  column("certify_seconds", layer.certify_seconds, "seconds.certify");
};

using Matrix34 = Eigen::Matrix<double, 3, 4>;

const std::vector<std::string> xyz = {"x", "y", "z"}, affine = {"x", "y", "z", "shift"};

constexpr auto transform_columns = [](auto& column, auto& layer) {
  Matrix34 transform = layer.inner_to_world.affine();
  column.matrix(affine, transform, "transform");
  if constexpr (std::remove_reference_t<decltype(column)>::reading) {
    layer.inner_to_world = Eigen::Affine3d::Identity();
    layer.inner_to_world.affine() = transform;
  }
};

template <class F, class L>
void layer_fields(F& f, L& layers) {
  f.value("layers/ended", "", layers.ended);
  auto& all = layers.layers;
  f.rows("layers/table", "layers", all, "1, 1, 1, 1, 1, mm, mm, 1, s, s, s", layer_columns);
  f.rows("layers/transforms", "layers", all, "1, 1, 1, mm", transform_columns);
  f.rows("layers/plane_normals", "layers", all, "1",
         [](auto& c, auto& layer) { c.matrix(xyz, layer.cut.normal, "plane.normal"); });
  f.rows("layers/plane_points", "layers", all, "mm", [](auto& c, auto& layer) {
    Vec3 point = layer.cut.offset * layer.cut.normal;
    c.matrix(xyz, point, "plane.point");
    if constexpr (std::remove_reference_t<decltype(c)>::reading)
      layer.cut.offset = point.dot(layer.cut.normal);
  });
  f.rows("layers/removal_plus", "layers", all, "1",
         [](auto& c, auto& layer) { c.matrix(xyz, layer.cut.plus, "removal.plus"); });
  f.rows("layers/removal_minus", "layers", all, "1",
         [](auto& c, auto& layer) { c.matrix(xyz, layer.cut.minus, "removal.minus"); });
}

template <class F, class A>
void accuracy_fields(F& f, A& a) {
  f.value("accuracy/placements", "placements", a.placements);
  f.value("accuracy/nested", "nested", a.nested);
  f.value("accuracy/exact_agrees", "exact_agrees", a.exact_agrees);
  f.value("accuracy/peel_disagrees", "peel_disagrees", a.peel_disagrees);
  f.value("accuracy/pixels", "pixels", a.pixels);
  f.rows("accuracy/errors", "errors", a.errors, "1", error_columns);
}

template <class F, class R>
void landscape_fields(F& f, R& r) {
  auto& landscape = *r.landscape;
  auto& map = landscape.map;
  f.value("landscape/step", "", map.step);
  f.value("landscape/inside", "inside", map.inside);
  f.value("landscape/descents", "searched_to_the_end", map.descents);
  f.value("landscape/seconds", "map_seconds", map.seconds);
  f.value("landscape/degrees", "best.degrees", landscape.degrees);
  f.bulk("landscape", [&](hdf5::Group& group) { write_landscape(group, landscape); });
  if constexpr (F::reading)
    f.load("landscape", [&](const hdf5::Group& group) { read_landscape(group, landscape); });
  if (!map.scale.empty()) {
    const double scale = map.scale[map.best()];
    f.given("scale", scale);
    if constexpr (F::reading) r.scale = scale;
  }
  if constexpr (!F::reading) {
    const Vec2 at = map.at(map.best());
    f.given("centroids", json{map.nx, map.ny});
    f.given("best.at", json{at.x(), at.y()});
  }
}

template <class F, class R>
void placement_fields(F& f, R& r) {
  if (!f.part("placement", "transform", r.placed)) {
    if (r.accuracy || r.landscape) return;
    f.given("plane", json{{"point", json_of(r.plane_point)}, {"normal", json_of(r.plane_normal)}});
    f.given("removal", json{{"plus", json_of(r.plus)}, {"minus", json_of(r.minus)}});
    return;
  }
  if constexpr (F::reading) r.placed = true;
  f.value("placement/transform", "transform", r.transform, "1, 1, 1, outer units");
  f.value("placement/plane_point", "plane.point", r.plane_point, "outer units");
  f.value("placement/plane_normal", "plane.normal", r.plane_normal, "1");
  f.value("placement/removal_plus", "removal.plus", r.plus, "1");
  f.value("placement/removal_minus", "removal.minus", r.minus, "1");
}

/// Scales are NaN in the file where there is none.
template <class F, class R>
void scale_fields(F& f, R& r) {
  std::optional<double> scale, certified;
  if (r.placed) scale = r.scale;
  if (r.certified && r.certified->scale > 0) certified = r.certified->scale;
  bool confirmed = r.certified && r.certified->confirmed;
  f.value("scale", "scale", scale);
  f.value("confirmed", "confirmed", confirmed);
  f.value("certified_scale", "certified_scale", certified);
  f.value("sampled_scale", "sampled_scale", r.sampled_scale);
  if constexpr (F::reading) {
    r.scale = scale.value_or(0);
    if (certified || confirmed) r.certified = {confirmed, certified.value_or(0), 0, {}};
  }
}

template <class F, class R>
void asked(F& f, R& r) {
  schema_fields(f, nest_schema);
  config_fields(f, r.config);
  f.stored("kind", std::string(kind_of(r.config)));
  f.given("kind", std::string(kind_of(r.config)));
  f.stored("shapes", shapes_text(r.config));
  f.given("shapes", shapes_text(r.config));
  provenance_fields(f, r.provenance);
}

/// What JSON repeats of the question, as the answer needs it.
template <class F, class R>
void asked_of_search(F& f, R& r) {
  const auto* swarm = part_of<NestSearch>(r.config);
  if (const auto* by = part_of<NestDecision>(r.config)) {
    f.given("variant", by->variant);
    f.given("resolution", by->resolution);
  }
  f.given("free", swarm ? swarm->free : "");
  f.given("swarm", swarm ? json(swarm->swarm) : json());
  f.given("seed", swarm || r.accuracy ? json(seed_of(r.config)) : json());
  const auto* outlines = std::get_if<NestOutlines>(&r.config.kind);
  if (!outlines) return;
  f.stored("landscape/rotations", outlines->rotations);
  f.given("rotations", outlines->rotations);
}

template <class F, class R>
void answer_fields(F& f, R& r) {
  const std::string inner = r.config.inner.empty() ? r.config.outer : r.config.inner;
  f.stored("outer", r.config.outer);
  f.given("outer", r.config.outer);
  f.stored("inner", inner);
  f.given("inner", inner);
  f.stored("seed", static_cast<std::int64_t>(seed_of(r.config)));
  f.value("outer_triangles", "", r.outer_triangles);
  f.value("inner_triangles", "", r.inner_triangles);
  f.given("triangles", r.outer_triangles + r.inner_triangles);
  f.given("outer_triangles", r.outer_triangles);
  f.given("inner_triangles", r.inner_triangles);
  std::string termination;
  if constexpr (!F::reading) termination = termination_of(r);
  f.value("termination", "termination", termination);
  if constexpr (F::reading)
    r.ending = termination == "interrupted"   ? NestResult::Ending::interrupted
               : termination == "out of time" ? NestResult::Ending::out_of_time
                                              : NestResult::Ending::whole;
  f.value("text", "text", r.text);
  f.value("valid", "valid", r.valid);
  f.value("evaluations", "evaluations", r.evaluations);
  f.value("setup_seconds", "seconds.setup", r.setup_seconds);
  f.value("search_seconds", "seconds.search", r.search_seconds);
  f.value("certify_seconds", "seconds.certify", r.certify_seconds);
  f.given("seconds.total", r.setup_seconds + r.search_seconds + r.certify_seconds);
}

/// Of a swarm, an iteration a row. Seconds are NaN where the search before a checkpoint did not tell them.
struct TraceRow {
  nest::SwarmStep step;
  double seconds;
};

constexpr auto trace_columns = [](auto& column, auto& row) {
  column("iteration", row.step.iteration);
  column("evaluations", row.step.evaluations);
  column("best", row.step.best);
  column("mean", row.step.mean);
  column("feasible", row.step.feasible);
  column("seconds", row.seconds);
};

template <class F, class R>
void trace_fields(F& f, R& r) {
  if (!f.part("trace", "", !r.trace.empty())) return;
  std::vector<TraceRow> rows;
  json shown = json::array();
  for (std::size_t i = 0; i < r.trace.size(); ++i) {
    const nest::SwarmStep& step = r.trace[i];
    rows.push_back(
        {step, i < r.trace_seconds.size() ? r.trace_seconds[i] : std::numeric_limits<double>::quiet_NaN()});
    shown.push_back({step.iteration, step.evaluations, step.best});
  }
  f.rows("trace", "", rows, "1, 1, 1, 1, 1, s", trace_columns);
  if (part_of<NestSearch>(r.config)) f.given("trace", shown);
  if constexpr (F::reading)
    for (const TraceRow& row : rows) {
      r.trace.push_back(row.step);
      r.trace_seconds.push_back(row.seconds);
    }
}

template <class F, class R>
void describe(F& f, R& r) {
  asked(f, r);
  asked_of_search(f, r);
  answer_fields(f, r);
  placement_fields(f, r);
  scale_fields(f, r);
  trace_fields(f, r);
  f.each("timings", r.timings, &NestTiming::variant, [&](auto& t, std::size_t) {
    f.flat("timings/" + t.variant, "timings." + t.variant, t, "ms, ms, 1", timing_columns);
  });
  if (f.part("accuracy", "", r.accuracy.has_value())) accuracy_fields(f, engaged<F>(r.accuracy));
  if (f.part("layers", "", r.layers.has_value())) layer_fields(f, engaged<F>(r.layers));
  if (f.part("landscape", "", r.landscape.has_value())) {
    engaged<F>(r.landscape);
    landscape_fields(f, r);
  }
  if (!r.shapes.empty()) f.bulk("shapes", [&](hdf5::Group& group) { write_shapes(group, r.shapes); });
}

}  // namespace of_nest
}  // namespace

void write_nest(const std::filesystem::path& path, const NestResult& result) {
  fields::write_with(path, [&](fields::ToHdf5& f) {
    of_nest::describe(f, result);
    fields::keep_summary(f, to_json(result));
  });
}

NestResult read_nest(const std::filesystem::path& path) {
  NestResult result;
  fields::read_with(path, nest_schema, [&](fields::FromHdf5& f) { of_nest::describe(f, result); });
  return result;
}

nlohmann::json to_json(const NestResult& result) {
  return fields::json_with([&](fields::ToJson& f) { of_nest::describe(f, result); });
}

}  // namespace kreisel::core
