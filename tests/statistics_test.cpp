#include "statistics.hpp"

#include <gtest/gtest.h>

namespace kreisel::core {
namespace THIS_FILE {

TEST(Statistics, MedianIsTheMiddleOrTheMeanOfBoth) {
  EXPECT_EQ(median({7}), 7);
  EXPECT_EQ(median({9, 1, 2}), 2);
  EXPECT_EQ(median({9, 1, 2, 4}), 3);
}

TEST(Statistics, QuantilesLieBetweenValuesInProportion) {
  EXPECT_EQ(quantile({3}, 0.95), 3);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0), 10);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 1), 40);
  EXPECT_EQ(quantile({40, 10, 30, 20}, 0.5), 25);
  EXPECT_EQ(quantile({40, 10, 30, 20, 50}, 0.25), 20);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
