#include "geometry/single_precision.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(SinglePrecision, RoundsEveryCoordinateOfAListInPlace) {
  Random random(5);
  std::vector<Vec3> points;
  for (int k = 0; k < 1000; ++k) points.push_back(random_vec(random, -100, 100));
  const std::vector<Vec3> before = points;
  for (Vec3& v : points) v = in_single_precision(v);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int a = 0; a < 3; ++a) {
      // By bits, which no optimiser takes for the same: a float has 23 of a double's 52.
      EXPECT_EQ(std::bit_cast<std::uint64_t>(points[k][a]) << 35, 0u) << before[k][a];
      EXPECT_NEAR(points[k][a], before[k][a], 100 * 6e-8);
    }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
