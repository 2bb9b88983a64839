#include "mesh/make/refine.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "body/mesh_moments.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(SplitEdges, LeavesTheSolidAsItIs) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 2, 1});
  const Moments before = reference::mesh_moments(mesh).value;
  const auto too_long = [](const Vec3& a, const Vec3& b) {
    const Vec3 corner(4, 2, 1), along = b - a;
    const double t = std::clamp(along.dot(corner - a) / along.squaredNorm(), 0.0, 1.0);
    return along.norm() > 0.3 && (a + t * along - corner).norm() < 1;
  };
  split_edges(mesh, too_long);
  EXPECT_GT(mesh.triangles.size(), 50u);
  EXPECT_NO_THROW(require_solid(mesh, "box"));
  EXPECT_EQ(inspect(mesh).flat_count, 0u);
  EXPECT_LT((reference::mesh_moments(mesh).value - before).cwiseAbs().maxCoeff(), 1e-12);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_FALSE(too_long(mesh.vertices[t[i]], mesh.vertices[t[(i + 1) % 3]]));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
