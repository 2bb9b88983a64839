#include "file/replace_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <set>
#include <stdexcept>

#include "temporary_folder.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

class ReplaceFile : public testing::Test {
 protected:
  void write(const std::string& name, std::chrono::hours age = {}) const {
    std::ofstream(folder_.path / name) << "old";
    fs::last_write_time(folder_.path / name, fs::file_time_type::clock::now() - age);
  }
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_.path)) all.insert(entry.path().filename());
    return all;
  }
  void replace() const {
    replace_file(folder_.path / "a.json", [](const fs::path& to) { std::ofstream(to) << "new"; });
  }
  /// Of a process that is gone.
  static pid_t dead() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);
    return child;
  }

  const TemporaryFolder folder_;
};

TEST_F(ReplaceFile, SweepsWhatKilledRunsLeftOfTheSameName) {
  const std::string gone = std::to_string(dead());
  write("a.json." + gone + "-0.tmp", std::chrono::hours(2));
  write("a.json." + gone + ".tmp", std::chrono::hours(2));
  const std::set<std::string> kept = {
      "a.json." + gone + "-1.tmp",                       // of this hour
      "a.json." + std::to_string(getppid()) + "-0.tmp",  // of a process that lives
      "a.json.backup.tmp",                               // none of ours
      "b.json." + gone + "-0.tmp",                       // of another file
  };
  for (const std::string& name : kept)
    write(name, name.ends_with("-1.tmp") ? std::chrono::hours(0) : std::chrono::hours(2));
  replace();
  std::set<std::string> expected = kept;
  expected.insert("a.json");
  EXPECT_EQ(names(), expected);
}

TEST_F(ReplaceFile, LeavesTheOldFileAndNothingElseWhereTheWriteFails) {
  write("a.json");
  EXPECT_THROW(replace_file(folder_.path / "a.json",
                            [](const fs::path& to) {
                              std::ofstream(to) << "half";
                              throw std::runtime_error("full");
                            }),
               std::runtime_error);
  EXPECT_EQ(names(), std::set<std::string>{"a.json"});
}

}  // namespace
}  // namespace kreisel::core
