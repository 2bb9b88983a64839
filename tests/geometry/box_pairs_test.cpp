#include "geometry/box_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

Pairs overlapping(const std::vector<NumberedBox>& boxes) {
  Pairs pairs;
  std::mutex finding;
  for_each_overlap(boxes, [&](std::uint32_t low, std::uint32_t high) {
    const std::scoped_lock lock(finding);
    pairs.push_back({low, high});
  });
  std::ranges::sort(pairs);
  return pairs;
}

Pairs by_trying_all(const std::vector<NumberedBox>& boxes) {
  Pairs pairs;
  for (const NumberedBox& a : boxes)
    for (const NumberedBox& b : boxes)
      if (a.number < b.number && a.meets(b)) pairs.push_back({a.number, b.number});
  std::ranges::sort(pairs);
  return pairs;
}

/// Corners at multiples of 1/16, so that many boxes merely touch. @param long_ones  one in so many
std::vector<NumberedBox> random_boxes(std::uint32_t count, double size, std::uint32_t long_ones,
                                      Random& random) {
  std::vector<NumberedBox> boxes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double longer = long_ones && i % long_ones == 0 ? 30 : 1;
    const Vec3 at = 16 * random_vec(random, 0, 1), by = longer * 16 * random_vec(random, 0, size);
    const Eigen::Vector3f lo = at.array().round().cast<float>(), span = by.array().round().cast<float>();
    boxes.push_back({lo / 16, (lo + span) / 16, 7 * i + 3});
  }
  std::ranges::shuffle(boxes, random);
  return boxes;
}

TEST(BoxPairs, AreThoseFoundByTryingAll) {
  Random random(22);
  for (const std::uint32_t count : {0u, 1u, 2u, 17u, 331u, 9001u})
    for (const std::uint32_t long_ones : {0u, 10u}) {
      const auto boxes = random_boxes(count, count > 1000 ? 0.05 : 0.2, long_ones, random);
      EXPECT_EQ(overlapping(boxes), by_trying_all(boxes)) << count << " boxes";
    }
}

TEST(BoxPairs, OfBoxesAllAtOnePlaceAreAll) {
  const std::vector<NumberedBox> here(100, {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), 0});
  auto boxes = here;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) boxes[i].number = i;
  EXPECT_EQ(overlapping(boxes).size(), 100u * 99 / 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
