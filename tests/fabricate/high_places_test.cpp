#include "fabricate/high_places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A closed solid over [0, 1] x [0, 1] between two height fields.
template <class Bottom, class Top>
TriangleMesh between(const Bottom& bottom, const Top& top, int n = 40) {
  TriangleMesh mesh;
  for (const bool upper : {false, true})
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double x = double(i) / n, y = double(j) / n;
        mesh.vertices.emplace_back(x, y, upper ? top(x, y) : bottom(x, y));
      }
  const auto at = [&](int i, int j, bool upper) {
    return static_cast<std::uint32_t>((upper ? (n + 1) * (n + 1) : 0) + j * (n + 1) + i);
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      quad(at(i, j, true), at(i + 1, j, true), at(i + 1, j + 1, true), at(i, j + 1, true));
      quad(at(i, j, false), at(i, j + 1, false), at(i + 1, j + 1, false), at(i + 1, j, false));
    }
  for (int i = 0; i < n; ++i) {
    quad(at(i, 0, false), at(i + 1, 0, false), at(i + 1, 0, true), at(i, 0, true));
    quad(at(i + 1, n, false), at(i, n, false), at(i, n, true), at(i + 1, n, true));
    quad(at(0, i + 1, false), at(0, i, false), at(0, i, true), at(0, i + 1, true));
    quad(at(n, i, false), at(n, i + 1, false), at(n, i + 1, true), at(n, i, true));
  }
  return mesh;
}

double flat(double, double) { return 0; }
/// Humps at x = 1/4 (height 3) and x = 3/4 (height 2.5), a saddle of 1 between them.
double humps(double x, double y) {
  const double along = std::sin(2 * std::numbers::pi * x), across = std::sin(std::numbers::pi * y);
  return 1 + (x < 0.5 ? 2 : 1.5) * along * along * across;
}

TEST(HighPlaces, OfAFlatTopIsOne) { EXPECT_EQ(high_places(box_mesh({0, 0, 0}, {1, 1, 1}), 1e-9).size(), 1u); }

TEST(HighPlaces, AreTheHumpsTheHighestFirst) {
  const std::vector<Vec3> places = high_places(between(flat, humps), 1);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_NEAR((places[0] - Vec3(0.25, 0.5, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((places[1] - Vec3(0.75, 0.5, 2.5)).norm(), 0, 1e-12);
}

TEST(HighPlaces, LeaveOutHumpsThatRiseLessThanAsked) {
  EXPECT_EQ(high_places(between(flat, humps), 1.499).size(), 2u);
  EXPECT_EQ(high_places(between(flat, humps), 1.501).size(), 1u);
}

TEST(HighPlaces, AreNotWhereTheSolidLiesAbove) {
  const auto dome = [](double x, double y) {
    return 0.5 * std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y);
  };
  const auto above = [](double x, double) { return 2 + x; };
  EXPECT_EQ(high_places(between(dome, above), 0.1).size(), 1u) << "the dome is a dent from below";
}

TEST(HighPlaces, OfARingThatStandsIsItsTop) {
  TriangleMesh ring = upright_torus_mesh(3, 1, 64, 32);
  const std::vector<Vec3> places = high_places(ring, 0.1);
  ASSERT_EQ(places.size(), 1u) << "the hole's top has the solid above it";
  EXPECT_NEAR(places[0][2], 4, 1e-12);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
