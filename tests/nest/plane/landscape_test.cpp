#include "nest/plane/landscape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/models/geodesic.hpp"
#include "body/test_meshes.hpp"
#include "mesh/make/prism.hpp"
#include "nest/decide/hybrid.hpp"
#include "refusal.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

constexpr double pi = std::numbers::pi;

Polygon square(double half) { return {{-half, -half}, {half, -half}, {half, half}, {-half, half}}; }

/// A radius for each of evenly spaced directions.
Polygon star(const std::vector<double>& radii) {
  Polygon polygon;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(radii.size());
    polygon.emplace_back(radii[i] * std::cos(angle), radii[i] * std::sin(angle));
  }
  return polygon;
}

Polygon disc(int corners) { return star(std::vector<double>(static_cast<std::size_t>(corners), 1.0)); }

/// A head with two ears, one bent over: rays from its middle leave it and enter it again.
Polygon bent() {
  return {{-1, -1},   {1, -1},    {1.1, 0.2}, {2.1, 0.5},  {2.1, 1.9},  {0.1, 2.2}, {0.1, 1.7},
          {1.6, 1.5}, {1.6, 0.9}, {0.8, 0.9}, {-0.2, 1.0}, {-0.9, 2.0}, {-1.2, 0.6}};
}

TEST(Silhouette, OfABallIsADiscAndOfABoxARectangle) {
  constexpr int pixels = 256;
  const double pixel = 2.0 / pixels;
  const Polygon round = silhouette(geodesic_sphere(20), Vec3(1, 2, 3), Vec3::UnitZ(), pixels);
  for (const Vec2& p : round) EXPECT_NEAR(p.norm(), 1, 2 * pixel);
  EXPECT_NEAR(area(round), pi, 0.01 * pi);
  const Polygon flat = silhouette(box_mesh({0, 0, 0}, {4, 1, 2}), Vec3::UnitY(), Vec3::UnitZ(), pixels);
  EXPECT_NEAR(area(flat), 8, 12 * 4.0 / pixels);
  EXPECT_LT(flat.size(), 13u);
}

TEST(Silhouette, TakesTheLargestPieceAndFillsItsHole) {
  // A torus seen along its axis beside a small box.
  TriangleMesh mesh = upright_torus_mesh(1, 0.3, 64, 16);
  const TriangleMesh box = box_mesh({2, 0, 0}, {2.5, 1, 0.5});
  for (const Triangle& t : box.triangles) {
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t i : t) mesh.vertices.push_back(box.vertices[i]);
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  const Polygon outline = silhouette(mesh, -Vec3::UnitY(), Vec3::UnitZ(), 400);
  EXPECT_NEAR(area(outline), pi * 1.3 * 1.3, 0.01 * 5.3);
  for (const Vec2& p : outline) EXPECT_LT(p.norm(), 1.32);
}

TEST(Silhouette, RefusesWhatHasNone) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  expect_refusal([&] { (void)silhouette(box, Vec3::UnitZ(), Vec3::UnitZ(), 100); },
                 "silhouette seen along its up direction", {});
  expect_refusal([&] { (void)silhouette(box, Vec3::UnitZ(), Vec3::UnitY(), 4); }, "silhouette of 4 pixels",
                 {});
  TriangleMesh sheet = box;
  for (Vec3& v : sheet.vertices) v.y() = 0.3;
  expect_refusal([&] { (void)silhouette(sheet, Vec3::UnitX(), Vec3::UnitY(), 100); },
                 "silhouette covers none of 100 pixels", {});
}

TEST(OpenTo, IsWhatCanBeReachedStraightFromTheCut) {
  // A T: a bar of 6 x 1 on a stem of 2 x 3.
  const Polygon tee = {{-1, 0}, {1, 0}, {1, 3}, {3, 3}, {3, 4}, {-3, 4}, {-3, 3}, {-1, 3}};
  const std::vector<OpenPart> stem = open_to(tee, 1.5);
  ASSERT_EQ(stem.size(), 1u);
  EXPECT_DOUBLE_EQ(stem[0].x0, -1);
  EXPECT_DOUBLE_EQ(stem[0].x1, 1);
  EXPECT_NEAR(area(stem[0].outline), 8, 1e-12) << "the stem and what of the bar is above it";
  EXPECT_NEAR(area(open_to(tee, 3.5)[0].outline), area(tee), 1e-12);
  // An upside-down U: two legs, each with the bar above it.
  const Polygon arch = {{0, 0}, {1, 0}, {1, 3}, {3, 3}, {3, 0}, {4, 0}, {4, 4}, {0, 4}};
  const std::vector<OpenPart> legs = open_to(arch, 1);
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_NEAR(area(legs[1].outline), 4, 1e-12);
  EXPECT_TRUE(open_to(arch, -1).empty());
}

TEST(Radial, FindsEveryCrossing) {
  const std::vector<Vec2> rays = circle(Vec2::Zero(), 1, 256);
  Radial seen(rays);
  const Vec2 from(0.3, -0.2);
  seen.see(disc(2000), from);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // |from + t u| = 1
    const double b = from.dot(rays[i]), t = -b + std::sqrt(b * b + 1 - from.squaredNorm());
    EXPECT_NEAR(seen.nearest()[i], t, 3e-6) << "sagitta of a 2000th of a turn: 1.3e-6";
  }
  EXPECT_TRUE(seen.several().empty());
  // From outside every ray crosses twice or not at all.
  seen.see(square(1), {-3, 0.01});
  const std::span<const float> ahead = seen.crossings(0);
  ASSERT_EQ(ahead.size(), 2u);
  EXPECT_FLOAT_EQ(ahead[0], 2);
  EXPECT_FLOAT_EQ(ahead[1], 4);
  EXPECT_TRUE(seen.crossings(128).empty());
}

/// With V of the outer shape at that height.
float largest(const PlaneShapes& shapes, const Vec2& at, int turn, int rays) {
  const std::vector<Vec2> all = circle(Vec2::Zero(), 1, rays);
  PlaneSearch search(shapes, all);
  for (const OpenPart& part : open_to(shapes.outer, at.y()))
    if (part.x0 < at.x() && at.x() < part.x1) {
      search.put(part.outline, at);
      return search.largest(turn, 0);
    }
  return 0;
}

TEST(PlaneSearch, KnowsSquares) {
  const PlaneShapes shapes = plane_shapes(square(1), square(1));
  EXPECT_NEAR(largest(shapes, {0, 0}, 0, 1024), 1, 1e-6);
  EXPECT_NEAR(largest(shapes, {0, 0}, 256, 1024), 1, 1e-6) << "a quarter turn";
  EXPECT_NEAR(largest(shapes, {0, 0}, 128, 1024), std::numbers::sqrt2 / 2, 1e-6);
  EXPECT_NEAR(largest(shapes, {0.3, 0}, 0, 1024), 0.7, 1e-6);
  EXPECT_NEAR(largest(shapes, {0.3, -0.45}, 0, 1024), 0.55, 1e-6);
  EXPECT_EQ(largest(shapes, {1.3, 0}, 0, 1024), 0);
}

TEST(PlaneSearch, TakesTheShapeOutThroughTheCut) {
  // In the stem of a T, below its wide bar, only the stem counts; in the bar, its height does.
  const Polygon tee = {{-1, 0}, {1, 0}, {1, 3}, {3, 3}, {3, 6}, {-3, 6}, {-3, 3}, {-1, 3}};
  const PlaneShapes shapes = plane_shapes(tee, square(1));
  EXPECT_NEAR(largest(shapes, {0, 2.9}, 0, 1024), 1, 1e-6);
  EXPECT_NEAR(largest(shapes, {0, 4.5}, 0, 1024), 1.5, 1e-6);
}

/// A height of the cut, a centroid and a rotation at random, decided by the search in space over prisms.
class BesidePrisms : public testing::TestWithParam<std::pair<Polygon, Polygon>> {};
INSTANTIATE_TEST_SUITE_P(Shapes, BesidePrisms,
                         testing::Values(std::pair(bent(), bent()), std::pair(bent(), square(1)),
                                         std::pair(star({2, 0.8, 2, 0.7, 2, 0.9, 2, 1}), bent()),
                                         std::pair(bent(), star({1, .5, 1, .4, 1.2}))));

TEST_P(BesidePrisms, FindsTheSameScale) {
  constexpr int rays = 1 << 15;
  const PlaneShapes shapes = plane_shapes(GetParam().first, GetParam().second);
  // So long that its ends are out of reach, and so flat that it reaches nowhere.
  const Nesting nesting(prism(shapes.outer, -10, 10), prism(shapes.inner, -0.005, 0.005));
  Random random(3);
  Hybrid learned(nesting);  // from one trial for the next
  int nested = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Vec2 at(uniform(random, -1.2, 2.1), uniform(random, -1, 2.2));
    const int turn = static_cast<int>(uniform(random, 0, rays));
    Placement placement;
    placement.pose.rotation = Eigen::AngleAxisd(2 * pi * turn / rays, Vec3::UnitZ()).toRotationMatrix();
    placement.pose.centroid = nesting.to_units(Vec3(at.x(), at.y(), 0));
    placement.cut = Cut::through(placement.pose.centroid, Vec3::UnitY());
    Hybrid hybrid(nesting);
    const double want = hybrid.search(placement, {.upper = 3, .abort_below = 0, .tolerance = 1e-5}).scale;
    EXPECT_NEAR(learned.search(placement, {.upper = 3, .abort_below = 0, .tolerance = 1e-5}).scale, want,
                2e-5)
        << trial;
    const float found = largest(shapes, at, turn, rays);
    // What lies between two rays, 2e-4 apart, on borders up to some ten times as steep as wide.
    EXPECT_NEAR(found, want, 2e-3 * std::max(want, 0.1)) << at.transpose() << ", turn " << turn;
    nested += want > 0;
  }
  EXPECT_GT(nested, 15);
}

TEST(Landscape, OfASquareHasItsTopInTheMiddleAndItsSymmetry) {
  const PlaneShapes shapes = plane_shapes(square(1), square(1));
  const Landscape found = landscape(shapes, {.columns = 5, .rotations = 64, .directions = 1024});
  ASSERT_EQ(found.nx, 5);
  ASSERT_EQ(found.ny, 5);
  EXPECT_EQ(found.inside, 25u);
  EXPECT_EQ(found.best(), 12u);
  EXPECT_NEAR(found.scale[12], 1, 1e-6);
  EXPECT_EQ(found.rotation[12] % 16, 0);
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_NEAR(found.scale[i], found.scale[24 - i], 1e-6);
    EXPECT_NEAR(found.scale[i], 1 - found.at(i).cwiseAbs().maxCoeff(), 1e-6) << "never better turned";
  }
}

TEST(Landscape, IsTheSameWithoutGivingUp) {
  const PlaneShapes shapes = plane_shapes(bent(), bent());
  LandscapeSpec spec{.columns = 12, .rotations = 128, .directions = 1024};
  const Landscape quick = landscape(shapes, spec);
  spec.abort = false;
  const Landscape whole = landscape(shapes, spec);
  EXPECT_EQ(quick.scale, whole.scale);
  EXPECT_LT(quick.descents, whole.descents / 4);
  EXPECT_EQ(whole.descents, whole.inside * 128);
}

TEST(Landscape, EndsWhenTold) {
  const PlaneShapes shapes = plane_shapes(square(1), square(1));
  const Landscape found =
      landscape(shapes, {.columns = 64, .rotations = 64, .directions = 64}, [](int, int) { return false; });
  EXPECT_FALSE(found.complete);
}

TEST(Landscape, RefusesWhatIsNone) {
  const PlaneShapes shapes = plane_shapes(square(1), square(1));
  expect_refusal([&] { (void)landscape(shapes, {.columns = 0}); }, "landscape of 0 columns", {});
  expect_refusal([&] { (void)landscape(shapes, {.rotations = 100, .directions = 128}); },
                 "100 rotations by 128 directions", {});
  expect_refusal([&] { (void)landscape(shapes, {.rotations = 1, .directions = 100}); }, "100 directions", {});
  Polygon clockwise = square(1);
  std::ranges::reverse(clockwise);
  expect_refusal([&] { (void)plane_shapes(clockwise, square(1)); }, "outline of 4 points encloses no area",
                 {});
  const Polygon horseshoe = {{0, 0}, {4, 0}, {4, 4}, {3.5, 4}, {3.5, 0.5}, {0.5, 0.5}, {0.5, 4}, {0, 4}};
  expect_refusal([&] { (void)plane_shapes(square(1), horseshoe); }, "the inner shape's centroid", {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
