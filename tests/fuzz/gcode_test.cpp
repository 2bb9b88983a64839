// gcode_test.cpp - every G-code that the fuzzer starts from, and what it has found: one line of bad input at
// most.
#include <gtest/gtest.h>

#include "fuzz/corpus.hpp"
#include "fuzz/feed.hpp"

namespace kreisel::core::fuzz {
namespace THIS_FILE {

TEST(FuzzedGcode, IsReadOrRefused) { expect_fed("gcode", feed_gcode); }

}  // namespace THIS_FILE
}  // namespace kreisel::core::fuzz
