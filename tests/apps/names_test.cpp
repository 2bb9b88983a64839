// names_test.cpp - what differs between problems or formulations is said where they are registered.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

/// A comparison of the name of a problem or formulation with a literal.
const std::regex comparison(R"re((problem|formulation)(\.name(\(\))?)?\s*[!=]=\s*"[a-z])re");

TEST(Names, OfProblemsAndFormulationsAreComparedNowhere) {
  std::size_t files = 0;
  std::string found;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(KREISEL_SOURCE) / "host")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    ++files;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (std::regex_search(line, comparison))
        found += entry.path().string() + ":" + std::to_string(number) + ": " + line + "\n";
    }
  }
  EXPECT_GT(files, 300u);
  EXPECT_EQ(found, "") << "expected a capability of its entry in the registry";
}

}  // namespace
}  // namespace kreisel::core
