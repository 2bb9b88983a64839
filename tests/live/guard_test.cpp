#include "live/guard.hpp"

#include <gtest/gtest.h>

namespace kreisel::core::live {
namespace THIS_FILE {

constexpr std::string_view here = "127.0.0.1:4711";
const Guard guard(4711, "0123456789abcdef");

TEST(Guard, LetsInWhoKnowsTheToken) {
  EXPECT_EQ(guard.path_of({"/0123456789abcdef/", here, {}}), "");
  EXPECT_EQ(guard.path_of({"/0123456789abcdef/main.js", here, {}}), "main.js");
  EXPECT_EQ(guard.path_of({"/0123456789abcdef/socket?x=1/2", "localhost:4711", "http://127.0.0.1:4711"}),
            "socket");
  EXPECT_EQ(guard.url(), "http://127.0.0.1:4711/0123456789abcdef/");
}

TEST(Guard, LetsNobodyElseIn) {
  for (const std::string_view target :
       {"/", "", "/0123456789abcdef", "/0123456789abcdeF/", "/0123456789abcde/", "//0123456789abcdef/",
        "/x/0123456789abcdef/", "?/0123456789abcdef/", "0123456789abcdef/", "/%30123456789abcdef/"})
    EXPECT_FALSE(guard.path_of({target, here, {}})) << target;
}

TEST(Guard, AnswersByItsOwnNameAlone) {
  for (const std::string_view host : {"", "127.0.0.1", "127.0.0.1:4712", "evil.example:4711", "evil.example",
                                      "127.0.0.1:4711.evil.example", "[::1]:4711"})
    EXPECT_FALSE(guard.path_of({"/0123456789abcdef/", host, {}})) << host;
}

TEST(Guard, AnswersNoOtherPage) {
  for (const std::string_view origin : {"", "null", "http://evil.example", "https://127.0.0.1:4711",
                                        "http://127.0.0.1:4712", "http://127.0.0.1:4711/", "file://"})
    EXPECT_FALSE(guard.path_of({"/0123456789abcdef/", here, origin})) << origin;
}

TEST(Guard, TokensAreLongAndNeverTheSame) {
  const std::string one = random_token(), other = random_token();
  EXPECT_EQ(one.size(), 32u);
  EXPECT_NE(one, other);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::live
