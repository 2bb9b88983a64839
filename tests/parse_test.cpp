#include "parse.hpp"

#include <gtest/gtest.h>

#include <string>

namespace kreisel::core {
namespace THIS_FILE {

TEST(Parse, TakesWholeNumbersWithOrWithoutASign) {
  EXPECT_EQ(parse<double>("0.25"), 0.25);
  EXPECT_EQ(parse<double>("-1e-3"), -1e-3);
  EXPECT_EQ(parse<double>("+2"), 2.0);
  EXPECT_EQ(parse<int>("17"), 17);
  EXPECT_EQ(parse<int>("+17"), 17);
  EXPECT_EQ(parse<int>("-3"), -3);
}

TEST(Parse, TakesAllOfTheTextOrNothing) {
  for (const char* text : {"", "+", "-", "+-5", "++5", "1,5", "1.5 ", " 1.5", "1.5mm", "abc", "0x10", "1e"})
    EXPECT_EQ(parse<double>(text), std::nullopt) << "'" << text << "'";
  for (const char* text : {"", "+-5", "5.5", "1e3", "99999999999999999999"})
    EXPECT_EQ(parse<int>(text), std::nullopt) << "'" << text << "'";
}

TEST(Parse, RefusesWhatIsNotFinite) {
  for (const char* text : {"inf", "-inf", "+inf", "infinity", "nan", "NaN", "-nan", "1e999"})
    EXPECT_EQ(parse<double>(text), std::nullopt) << text;
}

TEST(ParseWithUnit, WantsTheUnitRightAfterTheNumber) {
  EXPECT_EQ(parse_with_unit("60%", "%"), 60.0);
  EXPECT_EQ(parse_with_unit("-0.5g", "g"), -0.5);
  EXPECT_EQ(parse_with_unit("12mm", "mm"), 12.0);
  for (const char* text : {"60", "%", "", "60 %", "60%%", "%60", "x%"})
    EXPECT_EQ(parse_with_unit(text, "%"), std::nullopt) << "'" << text << "'";
}

TEST(ParseVector, TakesThreeNumbersBetweenTwoCommas) {
  EXPECT_EQ(parse_vector("1,-2.5,+3e1"), Eigen::Vector3d(1, -2.5, 30));
  for (const char* text :
       {"", "1", "1,2", "1,2,", ",2,3", "1,,3", "1,2,3,", "1,2,3,4", "1;2;3", "1, 2, 3", "1,2,nan", "a,b,c"})
    EXPECT_EQ(parse_vector(text), std::nullopt) << "'" << text << "'";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
