#include "nest/decide/nesting.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "error.hpp"

namespace kreisel::core::nest {
namespace {

/// What a mesh bounds. Sums over the triangles, so holes change them only by what they leave out.
struct Bulk {
  double area = 0, volume = 0;
  Vec3 area_centroid = Vec3::Zero(), volume_centroid = Vec3::Zero();
  Vec3 opening = Vec3::Zero();  ///< sum of the area vectors: zero for a closed mesh
};

Bulk bulk_of(const TriangleMesh& mesh) {
  Bulk bulk;
  const Vec3 centre = bounding_box(mesh).centre();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - centre, b = mesh.vertices[t[1]] - centre,
               c = mesh.vertices[t[2]] - centre;
    const Vec3 vector = 0.5 * (b - a).cross(c - a), sum = a + b + c;
    const double area = vector.norm(), volume = vector.dot(a) / 3;
    bulk.area += area;
    bulk.area_centroid += area / 3 * sum;
    bulk.volume += volume;
    bulk.volume_centroid += volume / 4 * sum;
    bulk.opening += vector;
  }
  if (bulk.area > 0) bulk.area_centroid = centre + bulk.area_centroid / bulk.area;
  if (bulk.volume != 0) bulk.volume_centroid = centre + bulk.volume_centroid / bulk.volume;
  return bulk;
}

// A mesh that encloses less than this of its box counts as a sheet; one whose hole has more than this of the
// surface's area, as gaping: a ray into it tells nothing.
constexpr double least_fill = 1e-6, most_opening = 0.1;

double box_volume(const Box& box) { return box.extent().prod(); }

void require_mesh(const TriangleMesh& mesh, const char* name) {
  if (mesh.triangles.empty() || mesh.vertices.empty())
    throw InputError(fmt::format("{} mesh has no triangles; expected one at least", name));
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite())
      throw InputError(
          fmt::format("{} mesh has a vertex at {}; expected finite coordinates", name, fmt::join(v, ", ")));
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t i : t)
      if (i >= mesh.vertices.size())
        throw InputError(fmt::format("{} mesh has a triangle with vertex {}; expected less than {}", name, i,
                                     mesh.vertices.size()));
  if (!(bounding_box(mesh).extent().maxCoeff() > 0))
    throw InputError(fmt::format("{} mesh is a single point; expected one with an extent", name));
}

void require_bulk(const Bulk& bulk, const Box& box, std::size_t triangles) {
  if (!(std::abs(bulk.volume) > least_fill * box_volume(box)))
    throw InputError(
        fmt::format("outer mesh encloses no volume ({} triangle{}); expected the surface of a solid",
                    triangles, triangles == 1 ? "" : "s"));
  if (bulk.opening.norm() > most_opening * bulk.area)
    throw InputError(
        fmt::format("outer mesh gapes: its openings are {:.0f} % of its area; expected at most {:.0f} %",
                    100 * bulk.opening.norm() / bulk.area, 100 * most_opening));
  if (bulk.volume < 0)
    throw InputError(
        fmt::format("outer mesh is inside out (volume {:.4g}); expected triangles that run "
                    "counter-clockwise seen from outside",
                    bulk.volume));
}

void require_unit(const Vec3& v, const char* name) {
  if (!v.allFinite() || std::abs(v.norm() - 1) > 1e-6)
    throw InputError(
        fmt::format("{} {:.6g} has length {:.6g}; expected 1", name, fmt::join(v, ","), v.norm()));
}

}  // namespace

Cut Cut::through(const Vec3& point, const Vec3& normal) {
  const Vec3 n = normal.normalized();
  return {{n, n.dot(point)}, n, -n};
}

void require_valid(const Placement& placement) {
  const Pose& pose = placement.pose;
  const Cut& cut = placement.cut;
  if (!std::isfinite(pose.scale) || !(pose.scale > 0))
    throw InputError(fmt::format("scale {:.6g}; expected a number > 0", pose.scale));
  const Eigen::Matrix3d& r = pose.rotation;
  const double skew = r.allFinite() ? (r * r.transpose() - Eigen::Matrix3d::Identity()).norm() : INFINITY;
  if (!(skew <= 1e-6))
    throw InputError(
        fmt::format("rotation stretches or shears (R R^T differs from 1 by {:.2g}); expected an "
                    "orthonormal matrix",
                    skew));
  if (r.determinant() < 0)
    throw InputError("rotation is a reflection (determinant -1); expected determinant 1");
  if (!pose.centroid.allFinite()) throw InputError("centroid is not finite; expected three numbers");
  require_unit(cut.normal, "normal");
  if (!std::isfinite(cut.offset)) throw InputError("offset of the plane is not finite; expected a number");
  require_unit(cut.plus, "removal direction plus");
  require_unit(cut.minus, "removal direction minus");
  if (!(cut.normal.dot(cut.plus) > 0))
    throw InputError(
        fmt::format("removal direction plus points below the plane (normal . plus = {:.4g}); "
                    "expected above it",
                    cut.normal.dot(cut.plus)));
  if (!(cut.normal.dot(cut.minus) < 0))
    throw InputError(
        fmt::format("removal direction minus points above the plane (normal . minus = {:.4g}); "
                    "expected below it",
                    cut.normal.dot(cut.minus)));
}

Nesting::Nesting(TriangleMesh outer, TriangleMesh inner)
    : outer_(std::move(outer)), inner_(std::move(inner)) {
  require_mesh(outer_, "outer");
  require_mesh(inner_, "inner");
  const Box box = bounding_box(outer_), inner_box = bounding_box(inner_);
  const Bulk bulk = bulk_of(outer_), inner_bulk = bulk_of(inner_);
  require_bulk(bulk, box, outer_.triangles.size());
  centre_ = box.centre();
  outer_centroid_ = bulk.volume_centroid;
  unit_ = 0.5 * box.extent().norm();
  const double inner_volume = std::abs(inner_bulk.volume);
  const bool solid = inner_volume > least_fill * box_volume(inner_box);
  inner_centroid_ = solid ? inner_bulk.volume_centroid : inner_bulk.area_centroid;
  largest_scale_ = box.extent().norm() / inner_box.extent().maxCoeff();
  if (solid) largest_scale_ = std::min(largest_scale_, std::cbrt(bulk.volume / inner_volume));
  for (Vec3& v : outer_.vertices) v = to_units(v);
  for (Vec3& v : inner_.vertices) v = (v - inner_centroid_) / unit_;
  box_ = bounding_box(outer_);
}

Eigen::Matrix<double, 3, 4> Nesting::transform(const Pose& pose) const {
  Eigen::Matrix<double, 3, 4> t;
  t.leftCols<3>() = pose.scale * pose.rotation;
  t.col(3) = to_file(pose.centroid) - t.leftCols<3>() * inner_centroid_;
  return t;
}

}  // namespace kreisel::core::nest
