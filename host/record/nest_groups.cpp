#include "record/nest_groups.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;

const std::vector<std::string> layer_columns = {
    "outer",     "inner",       "scale",          "certified_scale", "ratio",          "longest",
    "thickness", "evaluations", "offset_seconds", "search_seconds",  "certify_seconds"};

using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

void append(std::vector<double>& to, const Vec3& v) { to.insert(to.end(), v.begin(), v.end()); }

void write_outline(Group& group, const std::string& name, const Polygon& outline) {
  std::vector<double> points;
  for (const Vec2& p : outline) points.insert(points.end(), {p.x(), p.y()});
  group.write(name, points, {outline.size(), 2}, {"outer units", {"x", "y"}});
}

}  // namespace

void write_layers(Group group, const nest::Layers& layers) {
  group.set("ended", layers.ended);
  std::vector<double> rows, transforms, points, normals, plus, minus;
  for (const nest::Layer& layer : layers.layers) {
    rows.insert(rows.end(), {static_cast<double>(layer.outer), static_cast<double>(layer.inner), layer.scale,
                             layer.certified_scale, layer.ratio, layer.longest, layer.thickness,
                             static_cast<double>(layer.evaluations), layer.offset_seconds,
                             layer.search_seconds, layer.certify_seconds});
    const RowMajor34 transform = layer.inner_to_world.affine();
    transforms.insert(transforms.end(), transform.data(), transform.data() + transform.size());
    append(points, layer.cut.offset * layer.cut.normal);
    append(normals, layer.cut.normal);
    append(plus, layer.cut.plus);
    append(minus, layer.cut.minus);
  }
  const std::size_t n = layers.layers.size();
  group.write("table", rows, {n, layer_columns.size()}, {"1, 1, 1, 1, 1, mm, mm, 1, s, s, s", layer_columns});
  const std::vector<std::string> row = {"x", "y", "z", "shift"}, xyz = {"x", "y", "z"};
  group.write("transforms", transforms, {3 * n, 4}, {"1, 1, 1, mm", row});
  group.write("plane_points", points, {n, 3}, {"mm", xyz});
  group.write("plane_normals", normals, {n, 3}, {"1", xyz});
  group.write("removal_plus", plus, {n, 3}, {"1", xyz});
  group.write("removal_minus", minus, {n, 3}, {"1", xyz});
}

std::vector<LayerSummary> read_layers(const Group& group) {
  const auto table = group.read("table");
  if (table.shape.columns != layer_columns.size())
    throw InputError(
        fmt::format("layers/table has {} columns; expected {}", table.shape.columns, layer_columns.size()));
  std::vector<LayerSummary> layers;
  for (std::size_t i = 0; i < table.shape.rows; ++i) {
    const double* row = table.values.data() + i * layer_columns.size();
    layers.push_back({static_cast<std::size_t>(row[0]), static_cast<std::size_t>(row[1]), row[2], row[3],
                      row[4], row[5], row[6], row[7], row[8] + row[9] + row[10]});
  }
  return layers;
}

void write_landscape(Group group, const NestResult& result) {
  const nest::Landscape& map = result.landscape->map;
  const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
  const std::size_t best = map.best();
  group.set("step", map.step);
  group.set("rotations", std::get<NestOutlines>(result.config.kind).rotations);
  group.set("inside", static_cast<std::int64_t>(map.inside));
  group.set("descents", static_cast<std::int64_t>(map.descents));
  group.set("seconds", map.seconds);
  group.set("degrees", result.landscape->degrees);
  const std::vector<double> scale(map.scale.begin(), map.scale.end());
  group.write("scale", scale, {ny, nx}, {"1", {}});
  group.write("rotation", std::span<const int>(map.rotation), {ny, nx}, {"1", {}});
  group.write("origin", {map.origin.data(), 2}, {2}, {"outer units", {"x", "y"}});
  group.write("best", {map.at(best).eval().data(), 2}, {2}, {"outer units", {"x", "y"}});
  write_outline(group, "outer", result.landscape->outlines.outer);
  write_outline(group, "inner", result.landscape->outlines.inner);
}

LandscapeSummary read_landscape(const Group& group) {
  const auto scale = group.read("scale");
  const auto best = group.read("best").values;
  LandscapeSummary summary;
  summary.nx = static_cast<int>(scale.shape.columns);
  summary.ny = static_cast<int>(scale.shape.rows);
  summary.rotations = static_cast<int>(group.integer("rotations"));
  summary.inside = static_cast<double>(group.integer("inside"));
  summary.descents = static_cast<double>(group.integer("descents"));
  summary.seconds = group.real("seconds");
  if (!scale.values.empty()) summary.scale = std::ranges::max(scale.values);
  summary.degrees = group.real("degrees");
  summary.x = best.at(0);
  summary.y = best.at(1);
  return summary;
}

void write_shapes(Group group, const std::vector<TriangleMesh>& shapes) {
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    Group one = group.new_group(fmt::format("{}", k));
    std::vector<double> points;
    for (const Vec3& v : shapes[k].vertices) append(points, v);
    std::vector<int> corners;
    for (const Triangle& t : shapes[k].triangles)
      for (const std::uint32_t i : t) corners.push_back(static_cast<int>(i));
    one.write("vertices", points, {shapes[k].vertices.size(), 3}, {"its file's", {"x", "y", "z"}});
    one.write("triangles", std::span<const int>(corners), {shapes[k].triangles.size(), 3},
              {"1", {"a", "b", "c"}});
  }
}

}  // namespace kreisel::core
