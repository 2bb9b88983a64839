#include "experiment/watch.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "experiment/attempt.hpp"
#include "experiment/progress.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;

std::string text_of(const Seen& seen) {
  std::string text = fmt::format("{} of {} runs", seen.finished + seen.failed, seen.runs);
  if (seen.failed > 0) text += fmt::format(", {} failed", seen.failed);
  if (seen.absent > 0) text += fmt::format(", {} skipped for want of a file", seen.absent);
  if (seen.seconds_left && !seen.over())
    text += fmt::format("; about {} left", duration_text(*seen.seconds_left));
  const char* before = "; ";
  for (const auto& [node, count] : seen.by_node) {
    text += fmt::format("{}{} {}", before, node.empty() ? "unknown node" : node, count);
    before = ", ";
  }
  return text;
}

Watch::Watch(const Experiment& experiment, const fs::path& results) {
  // All as if nothing were there: look() reads what is.
  std::map<std::string, double> whole;
  for (PlannedRun& run : plan_runs(experiment, {.results = results, .force = true, .log = nullptr})) {
    const Effort effort = effort_of(run.run);
    whole[effort.kind] += effort.weight;
    runs_.push_back({std::move(run), effort.weight});
  }
  for (Known& known : runs_) known.share /= whole.at(effort_of(known.run.run).kind);
  kinds_ = whole.size();
  seen_.runs = runs_.size();
}

Seen Watch::look() {
  seen_.absent = 0;
  std::error_code gone;
  for (Known& known : runs_) {
    if (known.told) continue;
    const auto [state, node] = on_record(known.run);
    if (state == RunState::finished || state == RunState::failed) {
      known.told = true;
      ++(state == RunState::finished ? seen_.finished : seen_.failed);
      ++seen_.by_node[node];
      done_ += known.share;
      const auto when = fs::last_write_time(known.run.record, gone);
      if (!gone && (!first_ || when < *first_)) first_ = when, first_share_ = known.share;
    } else if (!known.run.lacks.empty()) {
      ++seen_.absent;
    }
  }
  seen_.seconds_left.reset();
  if (first_ && done_ > first_share_) {
    const std::chrono::duration<double> since = fs::file_time_type::clock::now() - *first_;
    seen_.seconds_left = since.count() * (static_cast<double>(kinds_) - done_) / (done_ - first_share_);
  }
  return seen_;
}

}  // namespace kreisel::core
