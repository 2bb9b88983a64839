#include "live/worker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <vector>

namespace kreisel::core::live {
namespace THIS_FILE {

using namespace std::chrono_literals;

/// Is it asked for within a time that no job of these tests takes?
bool comes(const std::stop_token& token) {
  for (int i = 0; i < 2000 && !token.stop_requested(); ++i) std::this_thread::sleep_for(1ms);
  return token.stop_requested();
}

TEST(Worker, DropsWhatWaitsForTheLatestOfItsKind) {
  std::promise<void> go, done;
  std::vector<int> answered;
  Worker worker;
  worker.put("ask", [&](const Worker::Turn&) { go.get_future().wait(); });
  for (const int k : {1, 2, 3}) worker.put("ask", [&, k](const Worker::Turn&) { answered.push_back(k); });
  worker.put("open", [&](const Worker::Turn&) { answered.push_back(10); });
  worker.put("ask", [&](const Worker::Turn&) {
    answered.push_back(4);
    done.set_value();
  });
  go.set_value();
  done.get_future().wait();
  EXPECT_EQ(answered, (std::vector{10, 4}));
}

TEST(Worker, TellsAJobThatOthersWait) {
  std::promise<void> begun;
  std::promise<std::pair<bool, bool>> seen;
  Worker worker;
  worker.put("ask", [&](const Worker::Turn& turn) {
    const bool ahead = turn.newer.stop_requested();
    begun.set_value();
    const bool after = comes(turn.newer) && !turn.closed.stop_requested();
    seen.set_value({ahead, after});
  });
  begun.get_future().wait();
  worker.put("ask", [](const Worker::Turn&) {});
  EXPECT_EQ(seen.get_future().get(), (std::pair{false, true}));
}

TEST(Worker, EndsWithItsJobAskedToStop) {
  std::promise<void> begun;
  bool stopped = false, later = false;
  {
    Worker worker;
    worker.put("long", [&](const Worker::Turn& turn) {
      begun.set_value();
      stopped = comes(turn.closed);
    });
    begun.get_future().wait();
    worker.put("other", [&](const Worker::Turn&) { later = true; });
  }
  EXPECT_TRUE(stopped);
  EXPECT_FALSE(later);
}

TEST(Worker, GoesOnAfterAStop) {
  std::promise<void> begun, done;
  Worker worker;
  worker.put("long", [&](const Worker::Turn& turn) {
    begun.set_value();
    EXPECT_TRUE(comes(turn.closed));
  });
  begun.get_future().wait();
  worker.stop();
  worker.put("next", [&](const Worker::Turn& turn) {
    EXPECT_FALSE(turn.closed.stop_requested());
    done.set_value();
  });
  done.get_future().wait();
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::live
