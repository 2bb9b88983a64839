#include "parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace kreisel::core {
namespace THIS_FILE {

TEST(ParallelFor, CallsEveryPieceOnce) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    parallel_for(count, [&](std::size_t i) { ++calls[i]; });
    for (const auto& n : calls) EXPECT_EQ(n, 1);
    parallel_for(count, 7, [&](std::size_t i) { ++calls[i]; });
    for (const auto& n : calls) EXPECT_EQ(n, 2) << "in blocks";
  }
}

TEST(ParallelFor, ThrowsWhatAPieceThrewAndBeginsNoFurtherPieces) {
  std::atomic<int> calls = 0;
  const auto failing = [&](std::size_t) {
    ++calls;
    throw std::runtime_error("piece");
  };
  EXPECT_THROW(parallel_for(100000, failing), std::runtime_error);
  EXPECT_LT(calls, 100000);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
