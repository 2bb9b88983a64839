#include "body/stem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "body/models.hpp"
#include "body/test_meshes.hpp"
#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

double volume(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; }

/// Of a polygon of 32 sides on the unit circle.
const double section = 16 * std::sin(std::numbers::pi / 16);

void expect_solid(const TriangleMesh& mesh) {
  EXPECT_NO_THROW(require_solid(mesh, "stemmed"));
  EXPECT_TRUE(self_intersections(mesh).empty());
}

TEST(Stem, UnderABoxAddsAPegAndACone) {
  const TriangleMesh box = box_mesh({-10, -8, 0}, {11, 9, 5});
  const Stemmed made = with_stem(box, {2, 2, 3});
  expect_solid(made.mesh);
  // A tenth of the radius lies between the bottom and the cone: 0.05 x 2.
  EXPECT_NEAR(made.point, -0.1 - 3, 1e-12);
  EXPECT_NEAR(volume(made.mesh), volume(box) + section * 4 * (0.1 + 3.0 / 3), 1e-9);
  EXPECT_NEAR(bounding_box(made.mesh).lo[2], made.point, 1e-12);
}

TEST(Stem, ReachesUpToWhereTheAxisEntersAndHasAShoulder) {
  // The letter C lying on its back: the axis enters it 2 above the lowest point.
  TriangleMesh arch =
      moved(letter_c_mesh(3), Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()).toRotationMatrix());
  for (Vec3& v : arch.vertices) v -= Vec3(1.5, 1.5, 0);
  const double bottom = bounding_box(arch).lo[2];
  const Stemmed made = with_stem(arch, {0.3, 0.2, 0.4});
  expect_solid(made.mesh);
  const double ring = bottom - 0.015, shoulder = section * 0.04 * 0.4 / 3;
  EXPECT_NEAR(volume(made.mesh) - volume(arch), section * 0.09 * (-1 - ring) + shoulder, 1e-9) << bottom;
}

TEST(Stem, OnCurvedBodiesIsClosedWhereverItIs) {
  Random random(304);
  for (const char* name : {"heart", "kitten", "bird"}) {
    const Model* model = find_model(name);
    const TriangleMesh mesh = model->make(24);
    int joined = 0;
    for (int trial = 0; trial < 12; ++trial) {
      const Eigen::Matrix3d turn = random_rotation(random);
      const Box box = bounding_box(mesh);
      TriangleMesh laid = moved(mesh, turn);
      const Vec3 middle = turn * (box.lo + box.hi) / 2;
      for (Vec3& v : laid.vertices) v -= middle;
      try {
        const Stemmed made = with_stem(laid, {1.5, 1.5, 2});
        expect_solid(made.mesh);
        EXPECT_GT(volume(made.mesh), volume(laid));
        ++joined;
      } catch (const InputError&) {  // another part is in the way
      }
    }
    EXPECT_GE(joined, 6) << name;
  }
}

TEST(Stem, IsRefusedWhereItCannotBeJoined) {
  const auto refused = [](const TriangleMesh& mesh, const Stem& stem) {
    try {
      (void)with_stem(mesh, stem);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("joined");
  };
  const TriangleMesh ring = moved(upright_torus_mesh(10, 2, 48, 24),
                                  Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix());
  EXPECT_NE(refused(ring, {1, 1, 1}).find("the axis does not meet the body"), std::string::npos);
  EXPECT_NE(refused(box_mesh({-1, -1, 0}, {1, 1, 4}), {3, 3, 1}).find("a stem of 3 mm radius"),
            std::string::npos);
}

TEST(StemSpec, TakesWhatIsLeftOutFromTheOthers) {
  EXPECT_FALSE(stem_of({}));
  EXPECT_EQ(stem_of({.radius = 2}), (Stem{2, 2, 2}));
  EXPECT_EQ(stem_of({.tip_radius = 1.5}), (Stem{1.5, 1.5, 1.5}));
  EXPECT_EQ(stem_of({.radius = 2, .tip_radius = 1, .tip_height = 3}), (Stem{2, 1, 3}));
  EXPECT_THROW((void)stem_of({.radius = -1}), InputError);
  EXPECT_THROW((void)stem_of({.radius = 1, .tip_radius = 2}), InputError);
  EXPECT_THROW((void)stem_of({.radius = NAN}), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
