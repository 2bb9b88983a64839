#include "body/body.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>

#include "body/mesh_moments.hpp"
#include "body/models.hpp"
#include "body/models/debian_meshes.hpp"
#include "body/test_meshes.hpp"
#include "error.hpp"
#include "installed.hpp"
#include "mesh/io/write.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A box of 20 x 10 x 5 mm with its corner at the origin, written as OFF.
class BodyOfABox : public testing::Test {
 protected:
  BodyOfABox() {
    const TriangleMesh mesh = box_mesh(Vec3::Zero(), {20, 10, 5});
    std::ofstream out(file_);
    out << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (const Vec3& v : mesh.vertices) out << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    for (const Triangle& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }

  [[nodiscard]] BodySpec spec() const {
    BodySpec spec;
    spec.model = file_.string();
    return spec;
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path / "brick.off";
};

/// The kernel's bound for 12 triangles and the few roundings of the frame, in numbers of order one.
double tolerance() {
  device::Device& device = test_device();
  return 8 * mesh_moments_bound(box_mesh({0, 0, 0}, {1, 1, 1}), device);
}

TEST_F(BodyOfABox, HasUnitMassInItsFrameAndItsContactAtTheOrigin) {
  const Body body = make_body(spec(), test_device());
  EXPECT_EQ(body.name, "brick");
  EXPECT_NEAR(body.frame.length, 10, 10 * tolerance()) << "cube root of 1000 mm^3";
  EXPECT_NEAR(body.mass_grams(), 1, tolerance()) << "1 cm^3 at 1 g/cm^3";
  EXPECT_EQ(body.axis, Vec3(0, 0, 1));
  EXPECT_LE((body.contact - Vec3(10, 5, 0)).norm(), 20 * 0x1p-52) << "middle of the lowest face";
  EXPECT_EQ(body.frame.to_body(body.contact), Vec3(0, 0, 0));
  const Moments want = box_moments({0, 0, 0.25}, {2, 1, 0.5});
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(body.solid[k], want[k], tolerance()) << moment_names[k];
}

TEST_F(BodyOfABox, StandsOnTheMiddleOfTheFaceItsAxisComesFrom) {
  for (const bool by_up : {false, true}) {
    BodySpec s = spec();
    (by_up ? s.up : s.axis) = Vec3(3, 0, 0);  // any length
    const Body body = make_body(s, test_device());
    EXPECT_EQ(body.axis, Vec3(1, 0, 0));
    EXPECT_LE((body.contact - Vec3(0, 5, 2.5)).norm(), 20 * 0x1p-52);
    EXPECT_LE((body.frame.rotation * body.axis - Vec3::UnitZ()).norm(), 8 * 0x1p-53);
    EXPECT_NEAR(body.frame.rotation.determinant(), 1, 16 * 0x1p-53);
    EXPECT_NEAR(centre_of_mass(body.solid)[2], 1, tolerance()) << "half of 20 mm in lengths of 10 mm";
    EXPECT_NEAR(bounding_box(body.local).extent()[2], 2, tolerance());
  }
}

TEST_F(BodyOfABox, TakesAContactPointAndAnyAxis) {
  BodySpec s = spec();
  s.contact = Vec3(1, 2, 3);
  s.axis = Vec3(1, -2, 0.5);
  const Body body = make_body(s, test_device());
  EXPECT_EQ(body.contact, Vec3(1, 2, 3));
  EXPECT_LE((body.frame.to_body(Vec3(1, 2, 3) + *s.axis) - Vec3(0, 0, s.axis->norm() / 10)).norm(),
            tolerance());
  for (const Vec3& v : body.mesh.vertices)
    EXPECT_LE((body.frame.to_model(body.frame.to_body(v)) - v).norm(), 20 * 16 * 0x1p-53);
  const TriangleMesh back = to_model(body.frame, body.local);
  for (std::size_t i = 0; i < back.vertices.size(); ++i)
    EXPECT_LE((back.vertices[i] - body.mesh.vertices[i]).norm(), 20 * 16 * 0x1p-53);
}

TEST_F(BodyOfABox, SizeSetsItsLongestSideAndLeavesBodyUnitsAlone) {
  BodySpec s = spec();
  s.size = 40;
  s.density = 2.5;
  const Body body = make_body(s, test_device());
  EXPECT_NEAR(bounding_box(body.mesh).extent().maxCoeff(), 40, 40 * 0x1p-52);
  EXPECT_NEAR(body.frame.length, 20, 20 * tolerance());
  EXPECT_NEAR(body.mass_grams(), 20, 20 * tolerance()) << "8 cm^3 at 2.5 g/cm^3";
  const Moments want = box_moments({0, 0, 0.25}, {2, 1, 0.5});
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(body.solid[k], want[k], tolerance()) << moment_names[k];
}

TEST_F(BodyOfABox, HollowedOutKeepsTheShellAndTakesTheFillBack) {
  const Body body = make_body(spec(), test_device());
  const Moments interior = box_moments({0, 0, 0.25}, {1.5, 0.5, 0.25});
  const MassModel mass = hollowed(body, interior);
  EXPECT_LE((mass.total(interior) - body.solid).cwiseAbs().maxCoeff(), 4 * 0x1p-53);
  EXPECT_LE((mass.total(Moments::Zero()) - (body.solid - interior)).cwiseAbs().maxCoeff(), 4 * 0x1p-53);
}

TEST_F(BodyOfABox, OfTwoMaterialsIsDesignedByTheHeavierWhicheverThatIs) {
  BodySpec s = spec();
  s.density = 2;
  const Moments interior = box_moments({0, 0, 0.25}, {1.5, 0.5, 0.25});
  const Moments half = box_moments({0.375, 0, 0.25}, {0.75, 0.5, 0.25});  // the upper half along x is void
  // In g/cm^3: interior, void; moments are in densities of the shell.
  for (const auto& [fill, filling] : {std::pair{8.0, 0.0}, {1.0, 0.5}, {2.0, 6.0}, {1.0, 6.0}, {0.5, 0.0}}) {
    s.interior_density = fill;
    s.void_density = filling;
    const Body body = make_body(s, test_device());
    EXPECT_NEAR(body.solid[S1], 1, tolerance());
    const MassModel mass = hollowed(body, interior);
    EXPECT_GT(mass.contrast, 0);
    const Moments want = body.solid - interior + fill / 2 * (interior - half) + filling / 2 * half;
    const Moments designed = body.heavy_voids() ? half : Moments(interior - half);
    EXPECT_LE((mass.total(designed) - want).cwiseAbs().maxCoeff(), 16 * 0x1p-53) << fill << " " << filling;
  }
}

TEST_F(BodyOfABox, RefusesDensitiesWithNothingToDesign) {
  const auto refused = [&](double density, std::optional<double> fill, double filling) {
    BodySpec s = spec();
    s.density = density;
    s.interior_density = fill;
    s.void_density = filling;
    EXPECT_THROW((void)make_body(s, test_device()), InputError) << density << " " << filling;
  };
  refused(0, {}, 0);
  refused(1, 0.0, 0);
  refused(1, -2.0, 0);
  refused(1, {}, 1);
  refused(1, 8.0, 8);
  refused(1, {}, -0.5);
  refused(1, {}, std::numeric_limits<double>::infinity());
}

TEST_F(BodyOfABox, MendsTheMeshOfAFileAndSaysSo) {
  std::ofstream(file_)
      << "OFF\n5 4 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n9 9 9\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n";
  const Body body = make_body(spec(), test_device());
  EXPECT_EQ(body.repairs, (std::vector<std::string>{"dropped 1 unused vertex", "turned 1 inside-out shell"}));
  EXPECT_EQ(body.mesh.vertices.size(), 4u);
  EXPECT_NEAR(body.solid[S1], 1, tolerance());
}

TEST_F(BodyOfABox, UnitesAMeshThatRunsThroughItself) {
  std::ofstream(file_) << "OFF\n8 8 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n1 1 -1\n7 1 -1\n1 7 -1\n1 1 5\n"
                          "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n";
  // Two corners of a cube of 36 mm^3 each, which share one of edge 4.
  const Body body = make_body(spec(), test_device());
  EXPECT_NEAR(std::pow(body.frame.length, 3), 72 - 64 / 6.0, 1e-9);
  ASSERT_EQ(body.repairs.size(), 1u);
  EXPECT_EQ(body.repairs[0].find("united what overlaps: 10.67 mm^3"), 0u) << body.repairs[0];
}

TEST(Body, OfEveryModelHasUnitMass) {
  for (const Model& model : models()) {
    BodySpec spec;
    spec.model = model.name;
    spec.fineness = 6;
    const Body body = make_body(spec, test_device());
    EXPECT_EQ(body.name, model.name);
    // Twice the bound: mass and length come from two sums. Cancellation inside a round shape is mild.
    EXPECT_NEAR(body.solid[S1], 1, 8 * mesh_moments_bound(body.local, test_device())) << model.name;
    EXPECT_GT(centre_of_mass(body.solid)[2], 0) << model.name << " lies above its contact point";
    EXPECT_GE(bounding_box(body.local).lo[2], -1e-12) << "the contact point is the lowest";
    EXPECT_EQ(body.local.triangles.size(), model.make(6).triangles.size()) << "as fine as was asked";
  }
}

TEST(Body, AxisToZIsARotationForEveryAxisEvenTheOpposite) {
  Random random(8);
  std::vector<Vec3> axes = {{0, 0, 1},     {0, 0, -1},   {1, 0, 0},     {0, -2, 0},
                            {1e-9, 0, -1}, {1e-9, 0, 1}, {2e-3, 0, -1}, {1e-3, 0, -1}};
  for (int i = 0; i < 20; ++i) axes.push_back(random_vec(random, -1, 1));
  for (const Vec3& axis : axes) {
    const Eigen::Matrix3d r = axis_to_z(axis);
    // Towards the opposite direction 1 + z loses digits, up to a millionth.
    EXPECT_LE((r * axis.normalized() - Vec3::UnitZ()).norm(), 4 * 0x1p-53 * 1e6) << axis.transpose();
    EXPECT_LE((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 32 * 0x1p-53) << axis.transpose();
    EXPECT_NEAR(r.determinant(), 1, 32 * 0x1p-53) << axis.transpose();
  }
}

void refuses(const BodySpec& spec, const std::vector<std::string>& parts) {
  expect_refusal([&] { (void)make_body(spec, test_device()); }, "", parts);
}

TEST_F(BodyOfABox, IsTakenInTheGivenUnitFromEveryFormatWithoutOne) {
  const TriangleMesh mesh = box_mesh(Vec3::Zero(), {20, 10, 5});
  for (const char* format : {"stl", "obj", "ply", "off"})
    for (const auto& [unit, factor] : {std::pair{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"in", 25.4}}) {
      BodySpec spec;
      spec.model = (folder_.path / fmt::format("brick.{}", format)).string();
      write_mesh(spec.model, {mesh});
      spec.unit = find_length_unit(unit);
      const Body body = make_body(spec, test_device());
      EXPECT_NEAR(body.frame.length, 10 * factor, 10 * factor * tolerance()) << format << ' ' << unit;
      EXPECT_EQ(bounding_box(body.mesh).hi, Vec3(factor * Vec3(20, 10, 5))) << format << ' ' << unit;
    }
}

TEST_F(BodyOfABox, IsScaledToItsSizeAfterItsUnit) {
  BodySpec s = spec();
  s.unit = find_length_unit("in");
  s.size = 50;
  const Body body = make_body(s, test_device());
  EXPECT_LE((bounding_box(body.mesh).hi - Vec3(50, 25, 12.5)).norm(), 50 * 0x1p-52);
  s.size.reset();
  s.contact = Vec3(254, 127, 0);
  EXPECT_EQ(make_body(s, test_device()).contact, Vec3(254, 127, 0)) << "in mm, whatever the file is in";
}

TEST_F(BodyOfABox, TakesNoUnitWhereThereIsOne) {
  BodySpec s;
  s.model = (folder_.path / "brick.3mf").string();
  write_mesh(s.model, {box_mesh(Vec3::Zero(), {20, 10, 5})});
  EXPECT_NEAR(make_body(s, test_device()).frame.length, 10, 10 * tolerance());
  s.unit = find_length_unit("mm");
  refuses(s, {"unit mm", "brick.3mf", "expected none with a file that says what its lengths are in"});
  for (const char* name : {"ellipsoid", "bunny"}) {
    s.model = name;
    refuses(s, {"unit mm", name, "expected none with the name of a model"});
  }
}

TEST(Body, RefusesADensityThatIsNotPositive) {
  for (const double density :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BodySpec spec;
    spec.density = density;
    refuses(spec, {"density", "g/cm^3", "expected > 0"});
  }
}

TEST(Body, RefusesASizeThatIsNotPositive) {
  for (const double size : {0.0, -60.0, std::numeric_limits<double>::quiet_NaN()}) {
    BodySpec spec;
    spec.size = size;
    refuses(spec, {"size", "mm", "expected > 0"});
  }
}

TEST(Body, RefusesAnAxisWithoutDirectionAndNamesTheOption) {
  BodySpec spec;
  spec.fineness = 2;
  spec.axis = Vec3(0, 0, 0);
  refuses(spec, {"--axis 0,0,0", "non-zero"});
  spec.axis = Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  refuses(spec, {"--axis", "non-zero"});
  spec.axis.reset();
  spec.up = Vec3(0, 0, 0);
  refuses(spec, {"--up 0,0,0", "non-zero"});
}

TEST(Body, RefusesAContactThatIsNotFinite) {
  BodySpec spec;
  spec.fineness = 2;
  spec.contact = Vec3(0, 0, std::numeric_limits<double>::infinity());
  refuses(spec, {"--contact", "expected three numbers"});
}

TEST(Body, RefusesAnUnknownModelAndNamesTheNearest) {
  BodySpec spec;
  for (const auto& [wrong, right] : {std::pair{"elipsoid", "'ellipsoid'"}, {"armadilo", "'armadillo'"}}) {
    spec.model = wrong;
    refuses(spec, {fmt::format("'{}'", wrong), fmt::format("did you mean {}?", right)});
  }
  spec.model = "qwertyuiop";
  refuses(spec, {"'qwertyuiop'", "`bench list`"});
}

TEST(Body, OfARealMeshStandsUprightAtItsSize) {
  KREISEL_NEEDS(debian_meshes_installed(), "libcgal-demo");
  BodySpec spec;
  spec.model = "elephant";
  const Body body = make_body(spec, test_device());
  EXPECT_EQ(body.name, "elephant");
  EXPECT_NEAR(bounding_box(body.mesh).extent().maxCoeff(), 60, 60 * 0x1p-51);
  EXPECT_EQ(body.axis, Vec3::UnitY());
  spec.up = Vec3::UnitX();
  EXPECT_EQ(make_body(spec, test_device()).axis, Vec3::UnitX()) << "--up leads the axis along";
}

TEST(Body, RefusesAFileThatDoesNotExist) {
  BodySpec spec;
  spec.model = "no_such_folder/part.stl";
  refuses(spec, {"no_such_folder/part.stl"});
}

TEST(Body, RefusesANegativeFineness) {
  BodySpec spec;
  spec.fineness = -3;
  refuses(spec, {"fineness -3", "ellipsoid", "expected >= 1"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
