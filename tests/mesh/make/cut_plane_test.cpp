#include "mesh/make/cut_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "body/models.hpp"
#include "error.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Moments moments_of(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value; }

TriangleMesh upside_down(TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v[2] = -v[2];
  return inverted(std::move(mesh));
}

/// Of a cut through vertices, which moves by as little as it must: a millionth of the size at the most.
constexpr double moved_by = 4e-6;

TEST(CutPlane, LeavesABoxOfTheHeightAboveIt) {
  const TriangleMesh box = box_mesh({-1, -2, 0}, {1, 2, 3});
  const TriangleMesh above = above_plane(box, 1);
  require_solid(above, "above");
  EXPECT_LE((moments_of(above) - box_moments({0, 0, 2}, {2, 4, 2})).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_TRUE(above_plane(box, 3).triangles.empty());
  const TriangleMesh whole = above_plane(box, -1);
  EXPECT_EQ(whole.triangles.size(), box.triangles.size());
  const TriangleMesh from_ground = above_plane(box, 0);
  require_solid(from_ground, "from the ground");
  EXPECT_NEAR(moments_of(from_ground)[S1], 24, 8 * moved_by);
}

TEST(CutPlane, BothSidesTogetherAreTheWholeWhateverTheSectionLooksLike) {
  struct Named {
    const char* name;
    TriangleMesh mesh;
    std::vector<double> heights;
  };
  // A torus that lies: two loops, one in the other; one that stands: two beside each other, or one; a letter:
  // a section that is not convex; models: many, and hundreds of corners.
  const std::vector<Named> all = {{"lying torus", torus(24, 16), {0, 0.3, -0.7}},
                                  {"standing torus", upright_torus_mesh(1, 0.3, 24, 12), {0, 0.8, 1.1}},
                                  {"letter", letter_c_mesh(1), {0.1, 0.5}},
                                  {"teapot", find_model("teapot")->make(8), {5, 17.3, 22}},
                                  {"woven ring", find_model("woven-ring")->make(12), {4, 6.9, 9}}};
  for (const Named& n : all)
    for (const double height : n.heights) {
      SCOPED_TRACE(std::string(n.name) + " at " + std::to_string(height));
      const TriangleMesh above = above_plane(n.mesh, height),
                         below = upside_down(above_plane(upside_down(n.mesh), -height));
      require_solid(above, "above");
      require_solid(below, "below");
      const Moments whole = moments_of(n.mesh), sum = moments_of(above) + moments_of(below);
      const double size = bounding_box(n.mesh).extent().norm(), scale = std::pow(size, 5) + whole[S1];
      EXPECT_LE((whole - sum).cwiseAbs().maxCoeff(), moved_by * scale);
      EXPECT_NEAR(sum[S1], whole[S1], moved_by * size * size * size);
      for (const Vec3& v : above.vertices) EXPECT_GE(v[2], height);
    }
}

TEST(CutPlane, MakesABlindHoleInTheCut) {
  const TriangleMesh box = box_mesh({-1, -2, 0}, {1, 2, 3});
  const BlindHole hole{{{0.2, -0.1}, {0.5, -0.1}, {0.5, 0.3}, {0.2, 0.3}}, 0.75};
  const TriangleMesh above = above_plane(box, 1, hole);
  require_solid(above, "above");
  const Moments want = box_moments({0, 0, 2}, {2, 4, 2}) - box_moments({0.35, 0.1, 1.375}, {0.3, 0.4, 0.75});
  EXPECT_LE((moments_of(above) - want).cwiseAbs().maxCoeff(), 1e-12);
  // In an annulus: the hole lies in the ring of a lying torus, of radius 3.
  const BlindHole beside{{{2.9, -0.1}, {3.1, -0.1}, {3.1, 0.1}, {2.9, 0.1}}, 0.5};
  const TriangleMesh half = above_plane(torus(24, 16), 0.01, beside);
  require_solid(half, "half");
  EXPECT_NEAR(moments_of(half)[S1] + 0.2 * 0.2 * 0.5, moments_of(above_plane(torus(24, 16), 0.01))[S1], 1e-9);
  EXPECT_THROW((void)above_plane(torus(24, 16), 0, {hole.polygon, 0.1}), InputError)
      << "in the torus' own hole";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
