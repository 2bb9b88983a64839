// cut_triangle_test.cpp - pieces that fill a triangle exactly, and have every line among their edges.
#include "geometry/cut_triangle.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace kreisel::core {
namespace THIS_FILE {

class CutTriangle : public ::testing::Test {
 protected:
  std::uint32_t number(ExactPoint p) {
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (points_[i] == p) return i;
    points_.push_back(std::move(p));
    return std::uint32_t(points_.size() - 1);
  }
  std::uint32_t at(double x, double y) { return number(ExactPoint(Vec3(x, y, 2 * x - y))); }

  TrianglePieces cut(const Triangle& corners, const std::vector<Segment>& segments) {
    return cut_triangle(
        corners, segments, [&](std::uint32_t p) -> const ExactPoint& { return points_[p]; },
        [&](ExactPoint p) { return number(std::move(p)); });
  }

  /// Twice the area seen along z, without rounding.
  mpq_class area(const Triangle& t) const {
    const auto a = points_[t[0]].exact(), b = points_[t[1]].exact(), c = points_[t[2]].exact();
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  void expect_filled(const Triangle& whole, const TrianglePieces& pieces) {
    mpq_class sum = 0;
    std::set<Segment> edges;
    for (const Triangle& t : pieces.triangles) {
      EXPECT_EQ(sgn(area(t)), sgn(area(whole)));
      sum += area(t);
      for (std::size_t k = 0; k < 3; ++k)
        edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    }
    EXPECT_EQ(sum, area(whole));
    for (const Segment& line : pieces.lines) EXPECT_TRUE(edges.contains(line));
  }

  std::deque<ExactPoint> points_;
};

TEST_F(CutTriangle, WithoutSegmentsStaysWhole) {
  const Triangle whole{at(0, 0), at(4, 0), at(0, 4)};
  const TrianglePieces pieces = cut(whole, {});
  EXPECT_EQ(pieces.triangles, std::vector<Triangle>{whole});
  EXPECT_EQ(pieces.lines.size(), 3u);
}

TEST_F(CutTriangle, AlongSegmentsThatCrossTouchAndLieOnEachOther) {
  const Triangle whole{at(0, 0), at(8, 0), at(0, 8)};
  const TrianglePieces pieces = cut(whole, {{at(1, 1), at(4, 3)},
                                            {at(1, 3), at(4, 1)},
                                            {at(4, 3), at(4, 1)},
                                            {at(4, 2), at(4, 0)},
                                            {at(0, 0), at(1, 1)},
                                            {at(0, 2), at(6, 2)}});
  expect_filled(whole, pieces);
  EXPECT_EQ(points_.size(), 3u + 4 + 4 + 1);  // the crossing of the first two, on the last
}

TEST_F(CutTriangle, WithAPointAloneHasItForACorner) {
  const Triangle whole{at(0, 0), at(0, 5), at(5, 0)};  // clockwise seen along z
  const std::uint32_t p = at(1, 2);
  const TrianglePieces pieces = cut(whole, {{p, p}});
  expect_filled(whole, pieces);
  EXPECT_EQ(pieces.triangles.size(), 3u);
}

TEST_F(CutTriangle, AlongAnyLines) {
  std::mt19937 random(4);
  for (int repeat = 0; repeat < 40; ++repeat) {
    points_.clear();
    const int size = repeat % 2 ? 1 << 20 : 12;  // on a coarse grid much falls together
    const Triangle whole{at(0, 0), at(size, 0), at(0, size)};
    const auto inside = [&] {
      const auto x = int(random() % unsigned(size)), y = int(random() % unsigned(size - x));
      return at(x, y);
    };
    std::vector<Segment> segments;
    for (int i = 0; i < 5 + repeat / 2; ++i) segments.push_back({inside(), inside()});
    expect_filled(whole, cut(whole, segments));
  }
}

TEST_F(CutTriangle, AThinOneAlongManyNearLines) {
  const Triangle whole{at(0, 0), at(1, 1e-9), at(1, 2e-9)};
  std::vector<Segment> segments;
  for (int i = 1; i < 20; ++i) {
    const double x = i / 32.0;
    segments.push_back(
        {number(ExactPoint(std::array<mpq_class, 3>{mpq_class(x), mpq_class(x) * mpq_class(1e-9),
                                                    mpq_class(2 * x) - mpq_class(x) * mpq_class(1e-9)})),
         whole[2]});
  }
  points_[2] =
      ExactPoint(std::array<mpq_class, 3>{mpq_class(1), mpq_class(2e-9), mpq_class(2) - mpq_class(2e-9)});
  points_[1] =
      ExactPoint(std::array<mpq_class, 3>{mpq_class(1), mpq_class(1e-9), mpq_class(2) - mpq_class(1e-9)});
  expect_filled(whole, cut(whole, segments));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
