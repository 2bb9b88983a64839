#include "fabricate/lay_flat.hpp"

#include <algorithm>
#include <cmath>

#include "body/frame.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/make/refill_ends.hpp"
#include "mesh/solid/repair.hpp"

namespace kreisel::core {
namespace {

/// Of all its surfaces, turned.
Box box_of(const MaterialPart& part, const Eigen::Affine3d& motion) {
  Box box;
  for (const TriangleMesh& mesh : part.surfaces)
    for (const Vec3& v : mesh.vertices) box.add(motion * v);
  return box;
}

}  // namespace

void lay_flat(std::vector<MaterialPart>& parts, double gap) {
  double x = 0;
  for (MaterialPart& part : parts) {
    const Eigen::Affine3d turn(part.down.isZero() ? Eigen::Matrix3d::Identity() : axis_to_z(-part.down));
    const Box box = box_of(part, turn);
    part.laid = Eigen::Translation3d(x - box.lo[0], -box.lo[1], -box.lo[2]) * turn;
    x += box.extent()[0] + gap;
  }
}

std::vector<TriangleMesh> laid_surfaces(const MaterialPart& part) {
  std::vector<TriangleMesh> surfaces = part.surfaces;
  if (part.laid.matrix().isIdentity(0)) return surfaces;
  // Less than corners keep from a cut (cut_part.hpp), more than they are rounded by.
  const double rounding = 2e-6 * box_of(part, part.laid).extent().maxCoeff();
  for (TriangleMesh& mesh : surfaces)
    for (Vec3& v : mesh.vertices) {
      v = in_single_precision(part.laid * v);
      if (std::abs(v[2]) < rounding) v[2] = 0;
    }
  if (surfaces.size() == 1) {
    // Rounded anew, corners may have become one, and edges of caps pass on the wrong side of them.
    RepairReport ignored;
    surfaces.front() = repaired(std::move(surfaces.front()), ignored);
    refill_ends(surfaces.front());
  }
  return surfaces;
}

}  // namespace kreisel::core
