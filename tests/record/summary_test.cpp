#include "record/summary.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace kreisel::core {
namespace THIS_FILE {

using nlohmann::json;

json everything() {
  const json numbers = {0,     23,    24,          255,         256,
                        65535, 65536, 4294967295U, 4294967296U, std::numeric_limits<std::uint64_t>::max(),
                        -1,    -24,   -25,         -257,        std::numeric_limits<std::int64_t>::min(),
                        0.5,   -0.1,  1e300,       5e-324};
  return {{"numbers", numbers},
          {"none", nullptr},
          {"yes", true},
          {"no", false},
          {"empty", {{"list", json::array()}, {"object", json::object()}, {"text", ""}}},
          {"text", std::string(300, 'x') + "\n\"\u00e9"},
          {"nested", {{"a", {1, {{"b", {2, 3}}}, "c"}}, {"d", {{"e", {{"f", 1.25}}}}}}}};
}

TEST(Summary, HoldsTheSameWhetherItIsPackedFromATreeOrFromText) {
  const json all = everything();
  for (const Summary& summary : {Summary(all), Summary::of_text(all.dump())}) {
    EXPECT_EQ(summary.whole(), all);
    EXPECT_EQ(summary.at("nested.a.1.b.0"), 2);
    EXPECT_EQ(summary.at("nested.d.e.f"), 1.25);
    EXPECT_EQ(summary.at("numbers.9"), std::numeric_limits<std::uint64_t>::max());
    EXPECT_TRUE(summary.at("nested.a.7").is_null());
    EXPECT_TRUE(summary.at("nothing").is_null());
  }
}

TEST(Summary, TextNeedNotBeSorted) {
  const Summary summary = Summary::of_text(R"( {"b": [1, 2], "c": "z", "a": {"x": 1}} )");
  EXPECT_EQ(summary.at("a.x"), 1);
  EXPECT_EQ(summary.at("b.1"), 2);
  EXPECT_EQ(summary.whole().dump(), R"({"a":{"x":1},"b":[1,2],"c":"z"})");
}

TEST(Summary, OfWhatIsNoObjectHasNoValues) {
  for (const char* text : {"", "3", "[1, 2]", "null", "{\"a\": 1", "{\"a\": [1, }", "{} {}"}) {
    const Summary summary = Summary::of_text(text);
    EXPECT_TRUE(summary.empty()) << text;
    EXPECT_TRUE(summary.at("a").is_null()) << text;
  }
  EXPECT_TRUE(Summary(json::array({1})).empty());
  EXPECT_FALSE(Summary::of_text("{}").empty());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
