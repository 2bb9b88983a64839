#include "fabricate/quadric_cavity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "domain/exact.hpp"
#include "domain/test_bodies.hpp"
#include "error.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "mesh/solid/solid.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Body model(const char* name) {
  BodySpec spec;
  spec.model = name;
  return make_body(spec, test_device());
}

/// kx (x - ox)^2 + ky (y - oy)^2 + kz (z - oz)^2 - r^2
Moments about(const Vec3& o, const Vec3& k, double r) {
  Moments q;
  q << k.dot(o.cwiseProduct(o)) - r * r, -2 * k.cwiseProduct(o), 0, 0, 0, k;
  return q;
}

double value(const Moments& q, const Vec3& p) {
  Moments t;
  t << 1, p, p[0] * p[1], p[1] * p[2], p[0] * p[2], p.cwiseAbs2();
  return q.dot(t);
}

Moments void_of(const TriangleMesh& cavity) { return -reference::mesh_moments(cavity).value; }

/// Of { q >= 0 } along the rays, each cut at the roots in z.
Moments void_of(const ExactColumns& domain, const Moments& q) {
  Moments sum = Moments::Zero();
  for (const ExactInterval& run : domain.intervals) {
    const double x = domain.grid.centre(0, run.ix), y = domain.grid.centre(1, run.iy);
    const double c = value(q, {x, y, 0}), b = (value(q, {x, y, 1}) - value(q, {x, y, -1})) / 2, a = q[SZZ];
    std::vector<double> cuts = {run.z0, run.z1};
    const double square = b * b - 4 * a * c;
    for (const double z : {(-b - std::sqrt(square)) / (2 * a), (-b + std::sqrt(square)) / (2 * a), -c / b})
      if (z > run.z0 && z < run.z1) cuts.push_back(z);  // a cut too many does no harm
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      const double middle = (cuts[i] + cuts[i - 1]) / 2;
      if (value(q, {x, y, middle}) >= 0)
        sum += box_moments({x, y, middle}, {domain.grid.h, domain.grid.h, cuts[i] - cuts[i - 1]});
    }
  }
  return sum;
}

/// Everything but the moments.
void expect_cavity(const Body& body, const TriangleMesh& cavity, double wall, const Moments& q, double cell) {
  EXPECT_TRUE(self_intersections(cavity).empty());
  TriangleMesh part;
  ASSERT_NO_THROW(part = make_solid(both(body.local, cavity), body.name).mesh);
  EXPECT_EQ(part.triangles.size(), body.local.triangles.size() + cavity.triangles.size()) << "mended";
  const SurfaceDistance distance(body.local);
  double least = 2 * wall, filled = 0;
  for (const Vec3& v : cavity.vertices) {
    least = std::min(least, distance(v, least));
    filled = std::min(filled, value(q, v));
  }
  for (const auto& [i, j, k] : cavity.triangles) {
    const Vec3 &a = cavity.vertices[i], &b = cavity.vertices[j], &c = cavity.vertices[k];
    for (const Vec3& p : {Vec3((a + b + c) / 3), Vec3((a + b) / 2), Vec3((b + c) / 2)})
      least = std::min(least, distance(p, least));
  }
  EXPECT_GE(least, wall - 1.01e-7 * cell);
  // Half a thousandth of an edge is as near to a point of the lattice as a vertex may come; |grad q| < 10
  // here.
  EXPECT_GE(filled, -1e-3 * cell * 10);
}

TEST(QuadricCavity, OfABoxCutByAPlaneHasItsClosedForm) {
  Random random(81);  // turned: a side along the lattice would meet all of its points at once, or none
  const Eigen::Matrix3d turn = random_rotation(random);
  const Body body = body_of(moved(box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5)), turn, Vec3::Zero()));
  Moments q = Moments::Zero();
  q[S1] = -0.1;
  q.segment<3>(SX) = turn.col(2);  // void where the turned z >= 0.1
  const double wall = 0.1;
  for (const double cell : {0.08, 0.04}) {
    const TriangleMesh cavity = quadric_cavity(body, wall, q, cell);
    expect_cavity(body, cavity, wall, q, cell);
    const double deep = std::sqrt(wall * wall + cell * cell / 3), side = 1 - 2 * deep, height = 0.4 - deep;
    const Moments want =
        transformed(box_moments({0, 0, 0.1 + height / 2}, {side, side, height}), turn, Vec3::Zero());
    const double error = (void_of(cavity) - want).cwiseAbs().maxCoeff();
    // The flat sides (less than 2.24 in all) are met but for a thousandth of a cell at a thousandth of the
    // points; the chamfers along four edges above and four upright ones are half a square of a cell at most.
    // Along the plane there are none.
    EXPECT_LT(error, 4 * (side + height) * cell * cell / 2 + 1e-3 * cell * 2.24);
    EXPECT_GT(error, 0) << "edges of the offset are chamfered";
  }
}

TEST(QuadricCavity, HasAnEdgeWhereQuadricAndOffsetMeet) {
  // A ball of radius 0.45 inside the box's sides at 0.4, of which the six caps are cut off: every vertex lies
  // on one of both surfaces, and where they meet the mesh has vertices on both.
  const Body body = body_of(box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5)));
  const double wall = 0.1, cell = 0.04, deep = std::sqrt(wall * wall + cell * cell / 3);
  const Moments q = -about(Vec3::Zero(), Vec3::Ones(), 0.45);
  const TriangleMesh cavity = quadric_cavity(body, wall, q, cell);
  expect_cavity(body, cavity, wall, q, cell);
  const double ring = std::sqrt(0.45 * 0.45 - (0.5 - deep) * (0.5 - deep));
  std::size_t on_both = 0, astray = 0;
  for (const Vec3& v : cavity.vertices) {
    const double off_ball = std::abs(v.norm() - 0.45),
                 off_side = std::abs(v.cwiseAbs().maxCoeff() - (0.5 - deep));
    astray += std::min(off_ball, off_side) > 2e-3 * cell;  // a thousandth: see quadric_cavity.hpp
    on_both += off_ball < 1e-5 * cell && off_side < 1e-5 * cell;
  }
  EXPECT_EQ(astray, 0u);
  // Each of six rings runs through a face of the lattice at least every cell.
  EXPECT_GT(on_both, 6 * 2 * std::numbers::pi * ring / cell);
}

TEST(QuadricCavity, ConvergesToTheRaysAsTheSquareOfItsCell) {
  const Body body = model("kitten");
  GridSpec spec;
  spec.resolution = 300;
  const Vec3 c = centre_of_mass(body.solid);
  const double length = bounding_box(body.local).extent().maxCoeff(), wall = 0.04 * length;
  const Moments q = about(c + Vec3(0.1, 0.05, 0.2), {1, 0.8, 1.5}, 0.25);
  Moments want;
  const auto error = [&](double n) {
    const double cell = length / n, deep = std::sqrt(wall * wall + cell * cell / 3);
    want = void_of(make_exact(body, spec, {deep * body.frame.length, Wall::millimetres}), q);
    return (void_of(quadric_cavity(body, wall, q, cell)) - want).cwiseAbs().maxCoeff();
  };
  const double coarse = error(28), fine = error(56);
  EXPECT_LT(coarse, 0.01 * want[S1]);
  EXPECT_NEAR(coarse / fine, 4, 1.5) << coarse << ' ' << fine;  // 4 and what the lattice's position does
}

TEST(QuadricCavity, IsACavityOfAnyBodyAndAnyQuadric) {
  for (const auto& [name, most] : {std::pair{"ellipsoid", 4}, {"kitten", 2}, {"bunny", 1}}) {
    const Body body = model(name);
    const Vec3 c = centre_of_mass(body.solid);
    const double length = bounding_box(body.local).extent().maxCoeff(), wall = 0.03 * length;
    const double cell = length / 40;
    const Moments quadrics[] = {about(c, {1, -1, 0.3}, 0.2), about(c, {1, 0.7, 0}, 0.3), Moments::Unit(S1),
                                -about(c + Vec3(0.2, 0, 0), {1, 1, 1}, 0.4)};
    for (int k = 0; k < most; ++k) {
      const TriangleMesh cavity = quadric_cavity(body, wall, quadrics[k], cell);
      EXPECT_GT(cavity.triangles.size(), 1000u);
      expect_cavity(body, cavity, wall, quadrics[k], cell);
    }
  }
}

TEST(QuadricCavity, LeavesAFilledCoreWithinTheVoid) {
  const Body body = body_of(box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5)));
  const TriangleMesh cavity = quadric_cavity(body, 0.1, about(Vec3::Zero(), Vec3::Ones(), 0.2), 0.05);
  const auto parts = shells(cavity);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_LT(parts[0].volume * parts[1].volume, 0) << "one faces in, one out";
}

TEST(QuadricCavity, IsEmptyWhereTheQuadricFillsEverything) {
  const Body body = body_of(box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5)));
  EXPECT_TRUE(quadric_cavity(body, 0.1, -Moments::Unit(S1), 0.05).triangles.empty());
}

TEST(QuadricCavity, RefusesACellThatIsThickerThanTheWall) {
  const Body body = body_of(box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5)));
  for (const double cell : {0.11, 0.0, -1.0, std::nan("")}) {
    try {
      (void)quadric_cavity(body, 0.1, Moments::Unit(S1), cell);
      ADD_FAILURE() << "accepted " << cell;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("cells of the cavity's mesh; expected at least one"),
                std::string::npos)
          << e.what();
    }
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
