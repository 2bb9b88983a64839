#include "deform/inner_surface.hpp"

#include <cmath>
#include <optional>

#include "geometry/distance.hpp"
#include "mesh/query/distance.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

/// What an end of a ray along `axis` hangs on; nothing where round-off leaves it nowhere.
std::optional<InnerPiece> piece_at(const TriangleMesh& skin, const SurfaceDistance& distance, const Vec3& at,
                                   double wall) {
  const auto nearest = distance.nearest(at, 1.01 * wall);
  if (!nearest) return std::nullopt;
  InnerPiece piece{at, Vec3::Zero(), 0, skin.triangles[*nearest], {}};
  const auto [a, b, c] = corners_of(skin, piece.corners);
  const Vec3 foot = nearest_on_triangle(at, a, b, c), out = foot - at;
  const Vec3 n = normal_of(a, b, c);
  const double square = n.squaredNorm();
  if (!(out.norm() > 0) || !(square > 0)) return std::nullopt;
  piece.normal = out.normalized();
  piece.barycentric = {normal_of(foot, b, c).dot(n) / square, normal_of(foot, c, a).dot(n) / square,
                       normal_of(foot, a, b).dot(n) / square};
  return piece;
}

/// @param area  by the normal's component along the rays
template <class Area>
void add_ends(std::vector<InnerPiece>& pieces, const TriangleMesh& skin, const SurfaceDistance& distance,
              double wall, const std::vector<Vec3>& ends, int axis, const Area& area) {
  std::vector<std::optional<InnerPiece>> found(ends.size());
  parallel_for(ends.size(), 256, [&](std::size_t i) { found[i] = piece_at(skin, distance, ends[i], wall); });
  for (auto& piece : found) {
    if (!piece) continue;
    piece->area = area(std::abs(piece->normal[axis]));
    pieces.push_back(*piece);
  }
}

/// Axis a of the mesh becomes z, in a turn of a third: no mirror image.
Vec3 turned(const Vec3& v, int a) { return {v[(a + 1) % 3], v[(a + 2) % 3], v[a]}; }
Vec3 turned_back(const Vec3& v, int a) {
  Vec3 back;
  back[(a + 1) % 3] = v[0];
  back[(a + 2) % 3] = v[1];
  back[a] = v[2];
  return back;
}

std::vector<Vec3> ends_of(const Grid& grid, const std::vector<ExactInterval>& intervals) {
  std::vector<Vec3> ends;
  ends.reserve(2 * intervals.size());
  for (const ExactInterval& i : intervals)
    for (const double z : {i.z0, i.z1}) ends.emplace_back(grid.centre(0, i.ix), grid.centre(1, i.iy), z);
  return ends;
}

}  // namespace

std::vector<InnerPiece> ray_ends(const TriangleMesh& skin, const ExactColumns& rays) {
  const SurfaceDistance distance(skin);
  std::vector<InnerPiece> pieces;
  const double square = rays.grid.h * rays.grid.h;
  add_ends(pieces, skin, distance, rays.wall, ends_of(rays.grid, rays.intervals), 2,
           [&](double nz) { return nz > 0 ? square / nz : 0.0; });
  return pieces;
}

std::vector<InnerPiece> inner_surface(const TriangleMesh& skin, double wall, double h) {
  const SurfaceDistance distance(skin);
  std::vector<InnerPiece> pieces;
  for (int axis = 0; axis < 3; ++axis) {
    TriangleMesh upright = skin;
    for (Vec3& v : upright.vertices) v = turned(v, axis);
    const Box box = bounding_box(upright);
    Grid grid;
    grid.h = h;
    for (int a = 0; a < 3; ++a) {
      grid.n[static_cast<std::size_t>(a)] = static_cast<int>(std::ceil(box.extent()[a] / h)) + 1;
      grid.origin[a] = box.centre()[a] - h * grid.n[static_cast<std::size_t>(a)] / 2;
    }
    std::vector<Vec3> ends = ends_of(grid, SolidLines(upright, grid).intervals(wall));
    for (Vec3& end : ends) end = turned_back(end, axis);
    add_ends(pieces, skin, distance, wall, ends, axis, [&](double n) { return h * h * n; });
  }
  return pieces;
}

}  // namespace kreisel::core
