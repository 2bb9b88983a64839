// experiments_test.cpp - every experiment that the fuzzer starts from, and what it has found.
#include <gtest/gtest.h>

#include "fuzz/corpus.hpp"
#include "fuzz/feed.hpp"

namespace kreisel::core::fuzz {
namespace THIS_FILE {

TEST(FuzzedExperiments, AreReadOrRefused) { expect_fed("experiment", feed_experiment); }

}  // namespace THIS_FILE
}  // namespace kreisel::core::fuzz
