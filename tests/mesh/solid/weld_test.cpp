#include "mesh/solid/weld.hpp"

#include <gtest/gtest.h>

#include "mesh/solid/check.hpp"
#include "mesh/solid/repair.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A box whose every triangle has corners of its own, each moved by `noise` in another direction.
TriangleMesh box_soup(const Vec3& at, const Vec3& extent, double noise) {
  constexpr std::uint32_t faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  TriangleMesh mesh;
  for (const auto& face : faces) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const std::uint32_t v : face) {
      const auto n = double(mesh.vertices.size());
      const Vec3 corner(v & 1 ? 1 : 0, v & 2 ? 1 : 0, v & 4 ? 1 : 0);
      mesh.vertices.push_back(
          at + corner.cwiseProduct(extent) +
          0.5 * noise * Vec3(std::cos(n), std::sin(n) * std::cos(3 * n), std::sin(n) * std::sin(3 * n)));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(Weld, ClosesWhatNoiseHasOpened) {
  RepairReport report;
  const TriangleMesh mesh = repaired(box_soup({3, -2, 1e-9}, {1, 2, 3}, 1e-7), report, 1e-7);
  EXPECT_TRUE(inspect(mesh).watertight());
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_NEAR(inspect(mesh).volume, 6, 11 * 1e-7);  // half the area, 22 / 2, times what a face may move
  ASSERT_EQ(report.lines.size(), 1u);
  EXPECT_EQ(report.lines[0], "welded 28 vertices to others at open edges, no more than 1e-07 apart");
}

TEST(Weld, NoiseBeyondTheToleranceStaysOpen) {
  RepairReport report;
  EXPECT_GT(inspect(repaired(box_soup({0, 0, 0}, {1, 2, 3}, 4e-7), report, 1e-7)).open.count, 0u);
}

TEST(Weld, NeverClosesASlitThatIsWiderThanTheTolerance) {
  // Two boxes with a slit between them, as triangles: both need welding, and lie just further than it apart.
  constexpr double within = 1e-6;
  TriangleMesh mesh = box_soup({0, 0, 0}, {1, 1, 1}, 1e-8);
  const TriangleMesh other = box_soup({1 + 1.02 * within, 0, 0}, {1, 1, 1}, 1e-8);
  const auto offset = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  RepairReport report;
  const TriangleMesh welded = repaired(mesh, report, within);
  EXPECT_TRUE(inspect(welded).watertight());
  EXPECT_EQ(welded.vertices.size(), 16u);
}

TEST(Weld, LeavesWhatIsClosedHoweverNearItsCornersAre) {
  RepairReport ignored;
  TriangleMesh thin = repaired(box_soup({0, 0, 0}, {1, 1, 1e-9}, 0), ignored);
  EXPECT_EQ(weld_open_edges(thin, 1e-3), 0u);
  EXPECT_EQ(thin.vertices.size(), 8u);
}

TEST(Weld, LeavesAMeshThatItWouldNotClose) {
  TriangleMesh open;  // a lone triangle with two corners at one place, nearly
  open.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}, {0, 1, 0}, {5, 5, 5}, {6, 5, 5}};
  open.triangles = {{0, 1, 3}, {2, 4, 5}};
  EXPECT_EQ(weld_open_edges(open, 1e-6), 0u);
  EXPECT_EQ(open.triangles[1], (Triangle{2, 4, 5}));
}

TEST(Weld, WorksAtAnySizeOfNumbers) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    RepairReport report;
    const TriangleMesh mesh =
        repaired(box_soup({0, 0, 0}, {scale, scale, scale}, 1e-9 * scale), report, 1e-9 * scale);
    EXPECT_TRUE(inspect(mesh).watertight()) << scale;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
