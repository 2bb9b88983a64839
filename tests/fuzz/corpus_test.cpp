// corpus_test.cpp - every file that the fuzzers start from, and what they have found: one line of bad input
// at most, in no time and little memory.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "fuzz/feed.hpp"
#include "mesh/io/format.hpp"
#include "places.hpp"

namespace kreisel::core::fuzz {
namespace THIS_FILE {

namespace fs = std::filesystem;

const fs::path corpus = fs::path(source_folder) / "tests" / "data" / "fuzz";

/// The libraries' own limits for one input are far above: sanitizers, and other work beside.
constexpr double most_seconds = 20;

TEST(FuzzCorpus, HasFilesForEveryMeshFormat) {
  for (const MeshFormat& format : mesh_formats()) {
    const fs::path folder = corpus / format.extension.substr(1);
    ASSERT_TRUE(fs::is_directory(folder)) << folder;
    EXPECT_GE(std::distance(fs::directory_iterator(folder), {}), 3) << folder;
  }
}

TEST(FuzzCorpus, IsReadOrRefused) {
  for (const fs::directory_entry& folder : fs::directory_iterator(corpus))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string reader = folder.path().filename().string();
      SCOPED_TRACE(entry.path().string());
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      const auto began = std::chrono::steady_clock::now();
      if (reader == "experiment")
        EXPECT_NO_THROW(feed_experiment(bytes));
      else
        EXPECT_NO_THROW(feed_mesh(reader, bytes));
      EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(),
                most_seconds);
    }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::fuzz
