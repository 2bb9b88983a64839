#include "fuzz/corpus.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "places.hpp"

namespace kreisel::core::fuzz {

namespace fs = std::filesystem;

/// The libraries' own limits for one input are far above: sanitizers, and other work beside.
constexpr double most_seconds = 20;

fs::path corpus_of(const std::string& reader) {
  return fs::path(source_folder) / "tests" / "data" / "fuzz" / reader;
}

void expect_fed(const std::string& reader, const std::function<void(const std::string& bytes)>& feed) {
  ASSERT_TRUE(fs::is_directory(corpus_of(reader))) << corpus_of(reader);
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(corpus_of(reader))) {
    SCOPED_TRACE(entry.path().string());
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto began = std::chrono::steady_clock::now();
    EXPECT_NO_THROW(feed(bytes));
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), most_seconds);
    ++files;
  }
  EXPECT_GE(files, 3);
}

}  // namespace kreisel::core::fuzz
