// names_test.cpp - what differs between problems or formulations is said where they are registered.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "places.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

/// Whether it compares the name of a problem or formulation with a literal: problem == "spin", and the like.
bool compares_a_name(std::string_view line) {
  for (const std::string_view sign : {" == \"", " != \""})
    for (std::size_t at = line.find(sign); at != line.npos; at = line.find(sign, at + 1)) {
      std::string_view left = line.substr(0, at);
      for (const std::string_view part : {"()", ".name"})
        if (left.ends_with(part)) left.remove_suffix(part.size());
      const std::size_t begin = at + sign.size();
      const bool of_word = begin < line.size() && std::isalpha(static_cast<unsigned char>(line[begin]));
      if (of_word && (left.ends_with("problem") || left.ends_with("formulation"))) return true;
    }
  return false;
}

TEST(Names, AreSeenWhereTheyAreCompared) {
  EXPECT_TRUE(compares_a_name("  if (config.problem == \"spin\") return;"));
  EXPECT_TRUE(compares_a_name("const bool floats = entry.problem.name != \"float\";"));
  EXPECT_TRUE(compares_a_name("  return find(formulation.name() == \"voxel\");"));
  EXPECT_FALSE(compares_a_name("  if (key == \"problem\") return;"));
}

TEST(Names, OfProblemsAndFormulationsAreComparedNowhere) {
  std::size_t files = 0;
  std::string found;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(source_folder) / "host")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    ++files;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (compares_a_name(line))
        found += entry.path().string() + ":" + std::to_string(number) + ": " + line + "\n";
    }
  }
  EXPECT_GT(files, 300u);
  EXPECT_EQ(found, "") << "expected a capability of its entry in the registry";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
