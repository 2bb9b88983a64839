#include "live/worker.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace kreisel::core::live {

Worker::Worker(Pace pace) : thread_([this, pace](const std::stop_token& ended) { run(pace, ended); }) {}

Worker::~Worker() {
  thread_.request_stop();
  stop();
}

void Worker::put(std::string kind, Job job) {
  const std::lock_guard lock(mutex_);
  if (!kind.empty()) std::erase_if(waiting_, [&](const Waiting& other) { return other.kind == kind; });
  waiting_.push_back({std::move(kind), std::move(job)});
  newer_.request_stop();
  more_.notify_one();
}

void Worker::stop() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  closed_.request_stop();
  newer_.request_stop();
}

void Worker::give_up(const std::vector<std::string_view>& kinds) {
  const auto among = [&](const std::string& kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const Waiting& other) { return among(other.kind); });
  if (!among(kind_)) return;
  closed_.request_stop();
  newer_.request_stop();
}

void Worker::run(Pace pace, const std::stop_token& ended) {
  // Of Linux threads each has a priority, and gives it to those that it starts.
  constexpr int behind_others = 10;
  if (pace == Pace::patient) ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), behind_others);
  std::unique_lock lock(mutex_);
  while (more_.wait(lock, ended, [&] { return !waiting_.empty(); })) {
    if (ended.stop_requested()) return;
    const Job job = std::move(waiting_.front().job);
    kind_ = std::move(waiting_.front().kind);
    waiting_.pop_front();
    closed_ = {};
    newer_ = {};
    if (!waiting_.empty()) newer_.request_stop();
    const Turn turn{closed_.get_token(), newer_.get_token()};
    lock.unlock();
    job(turn);
    lock.lock();
    kind_.clear();
  }
}

}  // namespace kreisel::core::live
