#include "record/nest_groups.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kreisel::core {
namespace {

using hdf5::Group;

void write_outline(Group& group, const std::string& name, const Polygon& outline) {
  std::vector<double> points;
  for (const Vec2& p : outline) points.insert(points.end(), {p.x(), p.y()});
  group.write(name, points, {outline.size(), 2}, {"outer units", {"x", "y"}});
}

}  // namespace

void write_landscape(hdf5::Group& group, const NestLandscape& landscape) {
  const nest::Landscape& map = landscape.map;
  const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
  const std::size_t best = map.best();
  const std::vector<double> scale(map.scale.begin(), map.scale.end());
  group.write("scale", scale, {ny, nx}, {"1", {}});
  group.write("rotation", std::span<const int>(map.rotation), {ny, nx}, {"1", {}});
  group.write("origin", {map.origin.data(), 2}, {2}, {"outer units", {"x", "y"}});
  group.write("best", {map.at(best).eval().data(), 2}, {2}, {"outer units", {"x", "y"}});
  write_outline(group, "outer", landscape.outlines.outer);
  write_outline(group, "inner", landscape.outlines.inner);
}

void read_landscape(const hdf5::Group& group, NestLandscape& landscape) {
  nest::Landscape& map = landscape.map;
  const auto scale = group.read("scale");
  map.nx = static_cast<int>(scale.shape.columns);
  map.ny = static_cast<int>(scale.shape.rows);
  map.scale.assign(scale.values.begin(), scale.values.end());
  map.rotation = group.read_integers("rotation").values;
  const std::vector<double> origin = group.read("origin").values;
  map.origin = {origin.at(0), origin.at(1)};
}

void write_shapes(hdf5::Group& group, const std::vector<TriangleMesh>& shapes) {
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    Group one = group.new_group(fmt::format("{}", k));
    std::vector<double> points;
    for (const Vec3& v : shapes[k].vertices) points.insert(points.end(), v.begin(), v.end());
    std::vector<int> corners;
    for (const Triangle& t : shapes[k].triangles)
      for (const std::uint32_t i : t) corners.push_back(static_cast<int>(i));
    one.write("vertices", points, {shapes[k].vertices.size(), 3}, {"its file's", {"x", "y", "z"}});
    one.write("triangles", std::span<const int>(corners), {shapes[k].triangles.size(), 3},
              {"1", {"a", "b", "c"}});
  }
}

}  // namespace kreisel::core
