#include "geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace kreisel::core {
namespace THIS_FILE {

__extension__ typedef __int128 Wide;  // not ISO, but of every 64-bit GCC and Clang

/// Sign of the determinant in integers: the coordinates are multiples of 2^-shift, small enough for 128 bits.
int integer_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int shift) {
  const auto whole = [&](const Vec3& p, const Vec3& q) {
    std::array<Wide, 3> r;
    for (int k = 0; k < 3; ++k)
      r[std::size_t(k)] = Wide(std::ldexp(p[k], shift)) - Wide(std::ldexp(q[k], shift));
    return r;
  };
  const auto u = whole(b, a), v = whole(c, a), w = whole(d, a);
  const Wide det = w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                   w[2] * (u[0] * v[1] - u[1] * v[0]);
  return (det > 0) - (det < 0);
}

TEST(Predicates, AgreeWithTheDefinitionOnAnExample) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orient3d(a, b, c, Vec3(0.2, 0.2, 1)), 1);
  EXPECT_EQ(orient3d(a, b, c, Vec3(0.2, 0.2, -1)), -1);
  EXPECT_EQ(orient3d(a, b, c, Vec3(7, -5, 0)), 0);
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orient2d({0, 0}, {1, 1}, {3, 3}), 0);
}

TEST(Predicates, SeeOneUnitInTheLastPlaceAcrossAPlane) {
  // The plane x + y + z = 1.5 through multiples of 2^-52; moving d by one of them decides.
  const double ulp = std::ldexp(1, -52);
  const Vec3 a(0.5, 0.5, 0.5), b(0.5 + 7 * ulp, 0.5 - 3 * ulp, 0.5 - 4 * ulp), c(1.25, 0.125, 0.125);
  const Vec3 d = a + (b - a) * 8 + (c - a) * 0.5;
  EXPECT_EQ(orient3d(a, b, c, d), 0);
  const int up = orient3d(a, b, c, d + Vec3(0, 0, ulp)), down = orient3d(a, b, c, d - Vec3(0, 0, ulp));
  EXPECT_NE(up, 0);
  EXPECT_EQ(up, -down);
}

TEST(Predicates, AgreeWithIntegersOnNearlyFlatTetrahedra) {
  // Multiples of 2^-36 below 1: differences have 37 bits, the determinant 37 * 3 + 3 = 114 of 127.
  constexpr int shift = 36;
  std::mt19937_64 random(5);
  std::uniform_int_distribution<std::int64_t> any(0, (std::int64_t{1} << shift) - 1), near(-1, 1);
  const auto point = [&] {
    return Vec3(std::ldexp(double(any(random)), -shift), std::ldexp(double(any(random)), -shift),
                std::ldexp(double(any(random)), -shift));
  };
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = point(), b = point(), c = point();
    Vec3 d = i % 2 ? Vec3(a + (b - a) * 0.25 + (c - a) * 0.5) : Vec3(0.5 * (a + b));  // on the plane, nearly
    for (int k = 0; k < 3; ++k)
      d[k] = std::ldexp(std::round(std::ldexp(d[k], shift)) + double(near(random)), -shift);
    const int want = integer_orient3d(a, b, c, d, shift);
    zeros += want == 0;
    ASSERT_EQ(orient3d(a, b, c, d), want) << i;
  }
  EXPECT_GT(zeros, 0);  // or the test says little
}

TEST(Predicates, ChangeSignWithEverySwap) {
  const Vec3 a(0.1, 0.2, 0.3), b(0.4, 0.5, 0.6), c(0.7, 0.8, 0.9 + 1e-16), d(0.11, 0.21, 0.31);
  const int s = orient3d(a, b, c, d);
  EXPECT_EQ(orient3d(b, a, c, d), -s);
  EXPECT_EQ(orient3d(a, c, b, d), -s);
  EXPECT_EQ(orient3d(a, b, d, c), -s);
  EXPECT_EQ(orient3d(b, c, a, d), s);
}

TEST(Predicates, FindTheProjectionOfSliversAndNoneOfLines) {
  const Vec3 a(0, 0, 0), b(1, 1, 1);
  EXPECT_EQ(projection_axis(a, b, Vec3(3, 3, 3)), -1);
  EXPECT_EQ(projection_axis(a, a, b), -1);
  EXPECT_NE(projection_axis(a, b, Vec3(3, 3, std::nextafter(3, 4))), -1);
  EXPECT_EQ(projection_axis(a, Vec3(1, 0, 0), Vec3(0, 1, 0.1)), 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
