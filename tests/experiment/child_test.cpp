#include "experiment/child.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Child, EndsByItselfWithItsCodeAndItsLastWords) {
  const ChildEnd end =
      run_child({"/bin/sh", "-c", "echo one >&2; echo two >&2; echo seen; exit 3"}, {}, true);
  EXPECT_EQ(end.limit, "");
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.last_words, "two");
  EXPECT_EQ(run_child({"/bin/sh", "-c", "kill -TERM $$"}).code, 128 + 15) << "a signal";
}

TEST(Child, IsEndedWhereItTakesLongerThanItMay) {
  const Stopwatch watch;
  const ChildEnd end = run_child({"/bin/sleep", "60"}, {0, 0.2});
  EXPECT_EQ(end.limit, "more than 0.2 s");
  EXPECT_LT(watch.seconds(), 30);
}

TEST(Child, IsEndedWhereItUsesMoreMemoryThanItMay) {
  // Copies by half a gigabyte at a time, without an end.
  const ChildEnd end = run_child({"/bin/dd", "if=/dev/zero", "of=/dev/null", "bs=500M"}, {0.1, 60}, true);
  EXPECT_EQ(end.limit, "more than 0.1 GB");
}

TEST(Child, MayUseWhatIsBelowItsLimits) {
  const ChildEnd end = run_child({"/bin/sleep", "0.1"}, {1, 60});
  EXPECT_EQ(end.limit, "");
  EXPECT_EQ(end.code, 0);
}

TEST(Child, IsRefusedWhereThereIsNoSuchProgram) {
  expect_refusal([] { (void)run_child({"/no/such/program"}); }, "/no/such/program: ", {});
  expect_refusal([] { (void)program_beside("no_such_program"); }, "", {"/no_such_program: no such file"});
}

TEST(Limits, AreToldFromOtherErrorsAndFromOtherLimits) {
  const Limits limits{8, 600};
  EXPECT_TRUE(is_limit(limits, "more than 8 GB"));
  EXPECT_TRUE(is_limit(limits, "more than 600 s"));
  EXPECT_FALSE(is_limit(limits, "more than 300 s")) << "it may now take longer";
  EXPECT_FALSE(is_limit(limits, ""));
  EXPECT_FALSE(is_limit({}, "more than 0 GB"));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
