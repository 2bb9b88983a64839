#include "fabricate/loose_pieces.hpp"

#include <gtest/gtest.h>

#include <array>

#include "body/test_meshes.hpp"
#include "fabricate/cut_part.hpp"
#include "geometry/moved.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 1e-4;  // a cut is made in single precision, and moved aside by a thousandth

TEST(LoosePieces, AreCountedWithWhatIsHollowInThem) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {4, 4, 4}), beside = box_mesh({6, 0, 0}, {8, 2, 2}),
                     cavity = turned_over(box_mesh({1, 1, 1}, {2, 2, 2}));
  const std::vector<double> pieces = loose_pieces({{.name = "a", .surfaces = {box, cavity}, .down = {}},
                                                   {.name = "b", .surfaces = {beside}, .down = {}}});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(pieces[0], 63, round_off);
  EXPECT_NEAR(pieces[1], 8, round_off);
}

TEST(LoosePieces, OfACutThroughTwoLegsAreThree) {
  // A table of two legs, cut through both: its top with what is left of them, and two feet.
  TriangleMesh table;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    table.triangles.push_back({a, b, c});
    table.triangles.push_back({a, c, d});
  };
  const double outline[8][2] = {{0, 0}, {2, 0}, {2, 4}, {6, 4}, {6, 0}, {8, 0}, {8, 6}, {0, 6}};
  for (const double y : {0.0, 2.0})
    for (const auto& [x, z] : outline) table.vertices.emplace_back(x, y, z);
  for (std::uint32_t i = 0; i < 8; ++i) quad(i, (i + 1) % 8, (i + 1) % 8 + 8, i + 8);
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 1, 2, 7}, {2, 3, 6, 7}, {3, 4, 5, 6}}) {
    quad(d, c, b, a);
    quad(a + 8, b + 8, c + 8, d + 8);
  }
  const MaterialPart part{.name = "part", .surfaces = {turned_over(table)}, .down = {}};
  const std::vector<double> pieces = loose_pieces(cut_part(part, std::vector<Plane>{{Vec3::UnitZ(), 1}}));
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_NEAR(pieces[0], 2 * (8 * 2 + 2 * 2 * 3), 0.1);
  EXPECT_NEAR(pieces[1], 4, 0.1);
  EXPECT_NEAR(pieces[2], 4, 0.1);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
