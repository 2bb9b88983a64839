#include "mesh/query/offset.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/test_meshes.hpp"
#include "mesh/query/distance.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Lines = std::vector<std::vector<Span>>;

void remove_shell(const TriangleMesh& mesh, double wall, const LineRaster& raster, Lines& lines) {
  LineSpans spans;
  for (const auto& line : lines) {
    spans.spans.insert(spans.spans.end(), line.begin(), line.end());
    spans.end_line();
  }
  const LineSpans left = ShellPieces(mesh).without_shell(wall, raster, spans);
  ASSERT_EQ(left.lines(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].assign(left[i].begin(), left[i].end());
}

/// What is left of the line x, y from z0 to z1.
std::vector<Span> left_of(const TriangleMesh& mesh, double wall, double x, double y, double z0 = -10,
                          double z1 = 10) {
  Lines lines(1);
  lines[0] = {{z0, z1}};
  remove_shell(mesh, wall, {x, y, 1, 1, 1}, lines);
  return lines[0];
}

TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

void expect_spans(const std::vector<Span>& got, const std::vector<Span>& want) {
  ASSERT_EQ(got.size(), want.size());
  // Lengths up to 10, a few roundings each.
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i].z0, want[i].z0, 16 * 10 * 0x1p-53);
    EXPECT_NEAR(got[i].z1, want[i].z1, 16 * 10 * 0x1p-53);
  }
}

TEST(Offset, OfATriangleIsItsPrismItsCylindersAndItsBalls) {
  const TriangleMesh flat = triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  const double inf = 10;
  expect_spans(left_of(flat, 0.5, 1, 1), {{-inf, 0.5}, {1.5, inf}});     // the face
  expect_spans(left_of(flat, 0.5, 2, -0.3), {{-inf, 0.6}, {1.4, inf}});  // beside an edge
  expect_spans(left_of(flat, 0.5, -0.3, 2), {{-inf, 0.6}, {1.4, inf}});  // beside another
  expect_spans(left_of(flat, 0.5, 4.3, -0.24), {{-inf, 1 - std::sqrt(0.25 - 0.09 - 0.0576)},
                                                {1 + std::sqrt(0.25 - 0.09 - 0.0576), inf}});  // a corner
  expect_spans(left_of(flat, 0.5, 2, -0.6), {{-inf, inf}});
  expect_spans(left_of(flat, 0.5, -0.4, -0.4), {{-inf, inf}});  // within the boxes, beyond the corner
  // Upright, in the plane of the line, and of a wall's thickness beside it.
  const TriangleMesh upright = triangle({0, 0, 0}, {2, 0, 0}, {0, 0, 2});
  expect_spans(left_of(upright, 0.5, 1, 0), {{-inf, -0.5}, {1 + std::sqrt(0.5), inf}});
  expect_spans(left_of(upright, 0.5, 0, 0.3), {{-inf, -0.4}, {2.4, inf}});
  expect_spans(left_of(upright, 0.5, 1, 0.6), {{-inf, inf}});
  // A sloped face: z = x, so the line stays within the wall for a height of wall * sqrt 2 each way.
  const TriangleMesh sloped = triangle({-5, -5, -5}, {5, -5, 5}, {0, 8, 0});
  expect_spans(left_of(sloped, 0.5, 0.25, 0),
               {{-inf, 0.25 - 0.5 * std::sqrt(2.0)}, {0.25 + 0.5 * std::sqrt(2.0), inf}});
}

TEST(Offset, OfWhatHasNoAreaIsThatOfItsEdges) {
  const TriangleMesh segment = triangle({0, 0, 0}, {1, 0, 0}, {3, 0, 0});
  expect_spans(left_of(segment, 0.5, 2, 0.3), {{-10, -0.4}, {0.4, 10}});
  const TriangleMesh vertical = triangle({0, 0, 0}, {0, 0, 1}, {0, 0, 3});
  expect_spans(left_of(vertical, 0.5, 0, 0.3), {{-10, -0.4}, {3.4, 10}});
  const TriangleMesh point = triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  expect_spans(left_of(point, 0.5, 0, 0.3), {{-10, -0.4}, {0.4, 10}});
}

TEST(Offset, IgnoresVerticesOfNoTriangle) {
  TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.vertices.emplace_back(0.2, 0.2, 5);
  expect_spans(left_of(mesh, 0.5, 0.2, 0.2), {{-10, -0.5}, {0.5, 10}});
}

TEST(Offset, LeavesEmptyLinesAndClosesWhatIsCovered) {
  const TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  Lines lines(4);
  lines[0] = {{0.1, 0.4}, {0.5, 0.6}};
  lines[1] = {};
  lines[2] = {{-3, -2}, {0, 1}, {2, 3}};
  lines[3] = {{0, 0.3}, {0.3, 0.7}};
  remove_shell(mesh, 0.25, {0.3, 0.4, 0.1, 2, 2}, lines);
  expect_spans(lines[0], {{0.25, 0.4}, {0.5, 0.6}});
  expect_spans(lines[1], {});
  expect_spans(lines[2], {{-3, -2}, {0.25, 0.75}, {2, 3}});
  expect_spans(lines[3], {{0.25, 0.3}, {0.3, 0.7}});
}

/// Everything that is left is as deep as the wall, everything taken out is not.
void expect_offset(const TriangleMesh& mesh, double wall, int n, double tolerance) {
  const SurfaceDistance distance(mesh);
  const Box box = bounding_box(mesh);
  const Vec3 lo = box.lo - Vec3::Constant(1.5 * wall), hi = box.hi + Vec3::Constant(1.5 * wall);
  const LineRaster raster{lo[0], lo[1], (hi - lo).head<2>().maxCoeff() / (n - 1), n, n};
  Lines lines(static_cast<std::size_t>(n) * n, {{lo[2], hi[2]}});
  remove_shell(mesh, wall, raster, lines);
  std::size_t kept = 0, taken = 0, wrong = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto& line = lines[static_cast<std::size_t>(i + n * j)];
      double below = lo[2];
      const auto depth = [&](double z) { return distance({raster.x(i), raster.y(j), z}, 10 * wall + 1); };
      for (std::size_t k = 0; k <= line.size(); ++k) {
        const double above = k < line.size() ? line[k].z0 : hi[2];
        for (const double t : {0.0, 0.001, 0.37, 0.999, 1.0}) {
          const double z = below + t * (above - below);
          if (above - below < 1e-9 || (z == lo[2] && above == lo[2])) continue;
          ++taken;
          wrong += depth(z) > wall + tolerance;
        }
        if (k == line.size()) break;
        for (const double t : {0.0, 0.001, 0.37, 0.999, 1.0}) {
          ++kept;
          wrong += depth(line[k].z0 + t * (line[k].z1 - line[k].z0)) < wall - tolerance;
        }
        below = line[k].z1;
      }
    }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(kept, 0u);
  EXPECT_GT(taken, 0u);
}

TEST(Offset, OfATorusAgreesWithItsDistances) {
  Random random(31);
  for (int trial = 0; trial < 3; ++trial)
    expect_offset(moved(upright_torus_mesh(0.75, 0.25, 48, 24), random_rotation(random), Vec3(1, -2, 3)),
                  0.06 + 0.05 * trial, 60, 64 * 4 * 0x1p-53);
}

TEST(Offset, OfAnyTrianglesAgreesWithTheirDistances) {
  // Acute, obtuse, huge; nothing that a solid would have to be.
  for (const std::uint64_t seed : {41, 42, 43})
    for (const double wall : {0.004, 0.05, 0.3}) expect_offset(triangle_soup(12, seed), wall, 50, 0x1p-44);
}

TEST(Offset, OfNeedlesAgreesWithTheirDistances) {
  Random random(51);
  for (const double height : {1e-3, 1e-6, 1e-9, 1e-13, 0.0})
    for (const double foot : {-0.5, 0.0, 0.3, 0.999}) {  // obtuse, right, caps
      TriangleMesh mesh;
      for (std::uint32_t k = 0; k < 6; ++k) {
        const Eigen::Matrix3d turn = k < 2 ? Eigen::Matrix3d::Identity() : random_rotation(random);
        const Vec3 shift = random_vec(random, -0.3, 0.3);
        for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(foot, height, 0)})
          mesh.vertices.push_back(turn * p + shift);
        mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
      }
      expect_offset(mesh, 0.1, 40, 0x1p-44);
    }
}

/// A closed mesh of many small triangles, crumpled: sharp and blunt edges, folds both ways, sheets through
/// each other.
TriangleMesh crumpled(double by, std::uint64_t seed) {
  TriangleMesh mesh = upright_torus_mesh(0.75, 0.25, 48, 24);
  Random random(seed);
  for (Vec3& v : mesh.vertices) v += random_vec(random, -by, by);
  return moved(mesh, random_rotation(random), Vec3(1, -2, 3));
}

TEST(Offset, OfSmallTrianglesAgreesWithTheirDistances) {
  // Sides of 0.07 to 0.1: half a wall, and a wall that reaches through many of them.
  for (const double by : {1e-9, 1e-4, 0.01, 0.05, 0.2})
    for (const double wall : {0.03, 0.1, 0.22}) expect_offset(crumpled(by, 71), wall, 60, 64 * 4 * 0x1p-53);
}

TEST(Offset, OfFoldsAgreesWithTheirDistances) {
  // Two triangles at an edge, from flat to shut, and both ways round. Sides of a tenth of the wall and of
  // ten walls.
  Random random(81);
  for (const double angle :
       {0.0, 1e-9, 1e-5, 5e-4, 2e-3, 0.1, 1.0, 1.6, 2.2, 3.0, 3.14, 3.1415926, 3.141592653589793})
    for (const double wall : {0.1, 10.0}) {
      const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.4, 0.9, 0),
          d(0.6, -0.8 * std::cos(angle), 0.8 * std::sin(angle));
      const TriangleMesh fold{{a, b, c, d}, {{0, 1, 2}, {1, 0, 3}}},
          turned{{a, b, c, d}, {{0, 1, 2}, {0, 1, 3}}};
      const Eigen::Matrix3d turn = random_rotation(random);
      expect_offset(moved(fold, turn, Vec3(0.1, 0.2, 0.3)), wall, 40, 64 * 16 * 0x1p-53);
      expect_offset(moved(turned, turn, Vec3(0.1, 0.2, 0.3)), wall, 40, 64 * 16 * 0x1p-53);
      expect_offset(fold, wall, 40, 64 * 16 * 0x1p-53);  // lines along the edge
    }
}

TEST(Offset, OfEdgesOfOneAndOfThreeTrianglesAgreesWithTheirDistances) {
  Random random(91);
  for (const double wall : {0.1, 3.0}) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.4, 0.9, 0), d(0.6, -0.8, 0.3), e(0.5, -0.2, -0.9);
    const TriangleMesh book{{a, b, c, d, e}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    expect_offset(moved(book, random_rotation(random), Vec3(0.1, 0.2, 0.3)), wall, 40, 64 * 4 * 0x1p-53);
  }
}

TEST(Offset, OfAFlatFineSideHasNoSeamsOnItsEdges) {
  // Lines through the corners and along the edges of a flat mesh, whose triangles are far smaller than the
  // wall, and far larger.
  TriangleMesh sheet;
  constexpr std::uint32_t n = 8;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) sheet.vertices.emplace_back(i, j, 0);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t at = i + (n + 1) * j;
      sheet.triangles.push_back({at, at + 1, at + n + 2});
      sheet.triangles.push_back({at, at + n + 2, at + n + 1});
    }
  for (const double wall : {0.25, 1.0, 6.0}) {
    Lines lines(33 * 33, {{-9, 9}});
    remove_shell(sheet, wall, {0, 0, 0.25, 33, 33}, lines);
    for (const auto& line : lines) expect_spans(line, {{-9, -wall}, {wall, 9}});
  }
}

TEST(Offset, OfAnotherWallIsThatOfAFreshOne) {
  const TriangleMesh mesh = crumpled(0.02, 72);
  const LineRaster raster{0, -3, 0.02, 100, 100};
  LineSpans lines;
  for (int i = 0; i < 100 * 100; ++i) {
    lines.spans.push_back({2, 4});
    lines.end_line();
  }
  const ShellPieces kept(mesh);
  for (const double wall : {0.05, 0.2, 0.01, 0.05}) {
    const LineSpans again = kept.without_shell(wall, raster, lines),
                    fresh = ShellPieces(mesh).without_shell(wall, raster, lines);
    EXPECT_EQ(again.first, fresh.first);
    EXPECT_TRUE(std::ranges::equal(
        again.spans, fresh.spans, [](const Span& a, const Span& b) { return a.z0 == b.z0 && a.z1 == b.z1; }));
    EXPECT_NE(again.spans.size(), lines.spans.size());
  }
}

TEST(Offset, LeavesNoSpeckAlongSeams) {
  // Lines through the seams of a cube's prisms, cylinders and balls, turned so that nothing is a round
  // number.
  Random random(61);
  for (int trial = 0; trial < 20; ++trial) {
    const TriangleMesh cube = moved(box_mesh(Vec3::Constant(-1), Vec3::Constant(1)), random_rotation(random),
                                    random_vec(random, -1, 1));
    for (const Vec3& v : cube.vertices) {
      const auto line = left_of(cube, 0.3, v[0], v[1], v[2] - 0.29, v[2] + 0.29);
      EXPECT_TRUE(line.empty()) << "a corner's own line";
    }
  }
}

TEST(Offset, DoesNotDependOnHowTheMeshIsCut) {
  // The same box, one side in two triangles or in a fan of needles.
  TriangleMesh fan = box_mesh({0, 0, 0}, {1, 1, 1});
  const auto middle = static_cast<std::uint32_t>(fan.vertices.size());
  fan.vertices.emplace_back(0.001, 0.5, 1);
  fan.triangles.erase(fan.triangles.begin() + 2, fan.triangles.begin() + 4);  // the top: 4 5 7 6
  for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}})
    fan.triangles.push_back({a, b, middle});
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  for (const double x : {0.2, 0.5, 0.77})
    expect_spans(left_of(fan, 0.15, x, 0.4, 0, 1), left_of(box, 0.15, x, 0.4, 0, 1));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
