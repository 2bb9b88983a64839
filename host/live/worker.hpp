// worker.hpp - a thread that does one job after the other, the latest of each kind.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace kreisel::core::live {

/// While somebody drags, questions come faster than they are answered: one that waits gives way to the next
/// of its kind, and one that is being answered learns that others wait.
class Worker {
 public:
  /// What may end a job.
  struct Turn {
    std::stop_token closed;  ///< nobody waits for it any more
    std::stop_token newer;   ///< that, or another job waits: for what is only worth it at rest
  };
  using Job = std::function<void(const Turn&)>;
  /// Whether somebody waits for each job, or others that run are to have the processor first.
  enum class Pace { prompt, patient };

  explicit Worker(Pace pace = Pace::prompt);
  /// Asks the job under way to stop, and waits for it.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// @param kind  a job of the same kind that waits is dropped; empty: none is
  void put(std::string kind, Job job);
  /// Asks the job under way to stop, and drops those that wait. Does not wait.
  void stop();
  /// The same of jobs of these kinds alone.
  void give_up(const std::vector<std::string_view>& kinds);

 private:
  struct Waiting {
    std::string kind;
    Job job;
  };
  void run(Pace pace, const std::stop_token& ended);

  std::mutex mutex_;
  std::condition_variable_any more_;
  std::deque<Waiting> waiting_;
  std::string kind_;                 ///< of the job under way
  std::stop_source closed_, newer_;  ///< of the same
  std::jthread thread_;              ///< the last, so that it ends first
};

}  // namespace kreisel::core::live
