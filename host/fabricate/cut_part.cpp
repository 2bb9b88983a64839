#include "fabricate/cut_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "error.hpp"
#include "mesh/cut_plane.hpp"
#include "mesh/encode.hpp"
#include "mesh/repair.hpp"

namespace kreisel {
namespace {

/// The middle of the widest gap between the heights of vertices, of those within `reach` of `wanted`.
double clear_of_corners(const TriangleMesh& mesh, double wanted, double reach) {
  std::vector<double> heights = {wanted - reach, wanted + reach};
  for (const Vec3& v : mesh.vertices)
    if (std::abs(v[2] - wanted) < reach) heights.push_back(v[2]);
  std::ranges::sort(heights);
  std::size_t widest = 1;
  for (std::size_t i = 2; i < heights.size(); ++i)
    if (heights[i] - heights[i - 1] > heights[widest] - heights[widest - 1]) widest = i;
  return (heights[widest] + heights[widest - 1]) / 2;
}

TriangleMesh turned(TriangleMesh mesh, const Eigen::Matrix3d& rotation) {
  for (Vec3& v : mesh.vertices) v = rotation * v;
  return mesh;
}

Vec3 in_single_precision(const Vec3& v) { return v.cast<float>().cast<double>(); }

/// Above and below; empty where there is nothing. @param solid  in single precision, and so are the halves
std::pair<TriangleMesh, TriangleMesh> split(const TriangleMesh& solid, const Cut& plane) {
  const Eigen::Matrix3d rotation = axis_to_z(plane.normal);
  const Eigen::DiagonalMatrix<double, 3> over(1, -1, -1);
  const TriangleMesh level = turned(solid, rotation);
  const double size = bounding_box(level).extent().maxCoeff(),
               height = clear_of_corners(level, plane.offset / plane.normal.norm(), 1e-3 * size);
  const auto half = [&](const Eigen::Matrix3d& turn, double at) {
    TriangleMesh mesh = above_plane(turned(solid, turn), at, {}, [&](const Vec3& v) -> Vec3 {
      return turn * in_single_precision(turn.transpose() * v);
    });
    mesh = turned(std::move(mesh), turn.transpose());
    for (Vec3& v : mesh.vertices) v = in_single_precision(v);  // there and back is round-off off
    RepairReport ignored;
    return mesh.triangles.empty() ? mesh : repaired(std::move(mesh), ignored);
  };
  return {half(rotation, height), half(over * rotation, -height)};
}

}  // namespace

std::vector<MaterialPart> cut_part(const MaterialPart& part, std::span<const Cut> planes) {
  std::vector<TriangleMesh> pieces = {joined(part.surfaces, part.name)};
  for (Vec3& v : pieces[0].vertices) v = in_single_precision(v);
  for (const Cut& plane : planes) {
    std::vector<TriangleMesh> next;
    for (const TriangleMesh& piece : pieces) {
      auto [above, below] = split(piece, plane);
      for (TriangleMesh* half : {&above, &below})
        if (!half->triangles.empty()) next.push_back(std::move(*half));
    }
    if (next.size() == pieces.size())
      throw InputError(
          fmt::format("the plane {:.4g},{:.4g},{:.4g} . x = {:.4g} misses the part; expected one "
                      "that cuts it",
                      plane.normal[0], plane.normal[1], plane.normal[2], plane.offset));
    pieces = std::move(next);
  }
  std::vector<MaterialPart> parts;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    parts.push_back({pieces.size() == 2 ? (i == 0 ? "upper" : "lower") : fmt::format("piece-{}", i + 1),
                     part.density,
                     {std::move(pieces[i])}});
  return parts;
}

}  // namespace kreisel
