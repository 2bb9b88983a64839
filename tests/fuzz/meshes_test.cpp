// meshes_test.cpp - every mesh that the fuzzers start from, and what they have found: one line of bad input
// at most, in no time and little memory.
#include <gtest/gtest.h>

#include "fuzz/corpus.hpp"
#include "fuzz/feed.hpp"
#include "mesh/io/format.hpp"

namespace kreisel::core::fuzz {
namespace THIS_FILE {

TEST(FuzzedMeshes, AreReadOrRefused) {
  for (const MeshFormat& format : mesh_formats()) {
    const std::string reader(format.extension.substr(1));
    expect_fed(reader, [&](const std::string& bytes) { feed_mesh(reader, bytes); });
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::fuzz
