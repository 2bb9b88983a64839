#include "file/replace_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <thread>

#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

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

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(ReplaceFile, KeepsThePermissionsOfAnEarlierFile) {
  write("a.json");
  for (const fs::perms mode : {fs::perms::owner_read | fs::perms::owner_write,
                               fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read,
                               fs::perms::owner_all | fs::perms::others_read}) {
    fs::permissions(folder_.path / "a.json", mode);
    replace();
    EXPECT_EQ(fs::status(folder_.path / "a.json").permissions(), mode);
    EXPECT_EQ(content_of(folder_.path / "a.json"), "new");
  }
}

TEST_F(ReplaceFile, WritesToWhatALinkLeadsTo) {
  fs::create_directory(folder_.path / "other");
  write("other/there.json");
  fs::create_symlink("other/next", folder_.path / "a.json");
  fs::create_symlink("there.json", folder_.path / "other/next");
  replace();
  EXPECT_EQ(content_of(folder_.path / "other/there.json"), "new");
  EXPECT_TRUE(fs::is_symlink(folder_.path / "a.json"));
  EXPECT_TRUE(fs::is_symlink(folder_.path / "other/next"));
  fs::remove(folder_.path / "other/there.json");  // a link to a file that is yet to be made
  replace();
  EXPECT_EQ(content_of(folder_.path / "other/there.json"), "new");
  EXPECT_TRUE(fs::is_symlink(folder_.path / "a.json"));
}

TEST_F(ReplaceFile, WritesIntoAPipeAndLeavesIt) {
  const fs::path pipe = folder_.path / "a.json";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = content_of(pipe); });
  replace();
  reader.join();
  EXPECT_EQ(got, "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(names(), std::set<std::string>{"a.json"});
}

TEST_F(ReplaceFile, GoesOnWithWhatIsOpenAlready) {
  const fs::path log = folder_.path / "log";
  const int open = ::open(log.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::write(open, "old ", 4), 4);
  const std::string name = "/proc/self/fd/" + std::to_string(open);
  EXPECT_TRUE(is_written_in_place(name));
  fs::create_symlink(name, folder_.path / "a.json");
  replace();
  ASSERT_EQ(::write(open, " more", 5), 5);
  EXPECT_EQ(content_of(log), "old new more");
  ::close(open);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
