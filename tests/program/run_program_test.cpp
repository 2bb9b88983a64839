#include "program/run_program.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stop_token>
#include <thread>

#include "refusal.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using By = ProgramEnd::By;
using Kept = ProgramSpec::Kept;

TEST(Programs, AreRunAndEnded) {
  const ProgramEnd end = run_program(
      {.words = {"sh", "-c", "echo first; echo last words >&2; exit 3"}, .kept = Kept::all, .seconds = 10});
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.by, By::itself);
  EXPECT_EQ(end.last_words, "last words");
  const Stopwatch watch;
  EXPECT_EQ(run_program({.words = {"sleep", "60"}, .seconds = 0.2}).by, By::time);
  std::stop_source stop;
  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop.request_stop();
  });
  EXPECT_EQ(run_program({.words = {"sleep", "60"}, .seconds = 60, .stop = stop.get_token()}).by, By::stop);
  EXPECT_LT(watch.seconds(), 20);
  expect_refusal([] { (void)run_program({.words = {"/nowhere/slicer"}}); }, "/nowhere/slicer: ", {});
}

TEST(Programs, KeepOfTheirWordsWhatIsAskedFor) {
  const std::vector<std::string> words = {"sh", "-c", "echo wrong >&2; echo right"};
  EXPECT_EQ(run_program({.words = words, .kept = Kept::errors}).last_words, "wrong");
  EXPECT_EQ(run_program({.words = words, .kept = Kept::all}).last_words, "right");
  // One line, without what would move a terminal's cursor.
  EXPECT_EQ(run_program({.words = {"printf", "a\\tb\\r\\n \\n"}, .kept = Kept::all}).last_words, "a b ");
}

TEST(Programs, AreFoundByFileOrName) {
  EXPECT_TRUE(is_program("sh"));
  EXPECT_TRUE(is_program("/bin/sh"));
  EXPECT_FALSE(is_program("/bin"));
  EXPECT_FALSE(is_program("no-such-program"));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
