#include "nearest.hpp"

#include <gtest/gtest.h>

namespace kreisel::core {
namespace THIS_FILE {

TEST(Nearest, CountsLettersPutInLeftOutReplacedAndSwapped) {
  EXPECT_EQ(edit_distance("duck", "duck"), 0u);
  EXPECT_EQ(edit_distance("", "duck"), 4u);
  EXPECT_EQ(edit_distance("dukc", "duck"), 1u);
  EXPECT_EQ(edit_distance("ducks", "duck"), 1u);
  EXPECT_EQ(edit_distance("dick", "duck"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(Nearest, FindsWhatWasMeantAndNothingWhenNoneIsClose) {
  const std::vector<std::string_view> names = {"duck", "kitten", "teapot"};
  EXPECT_EQ(nearest("dukc", names), "duck");
  EXPECT_EQ(nearest("Kitten", names), "kitten");
  EXPECT_EQ(nearest("tea", names), "") << "half of the letters are missing";
  EXPECT_EQ(nearest("ellipsoid", names), "");
  EXPECT_EQ(nearest("duck", std::vector<std::string>{}), "");
}

TEST(Nearest, PrefersTheFirstOfEquals) {
  EXPECT_EQ(nearest("cat", std::vector<std::string>{"car", "cab"}), "car");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
