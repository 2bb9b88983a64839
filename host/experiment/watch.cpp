#include "experiment/watch.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

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
}

Seen Watch::look() {
  Seen seen;
  seen.runs = runs_.size();
  double done = 0;  // of all work
  const Known* first = nullptr;
  for (Known& known : runs_) {
    if (known.found.state != RunState::finished) {
      known.found = on_record(known.run);
      std::error_code gone;
      known.written = fs::last_write_time(known.run.record, gone);
    }
    const bool finished = known.found.state == RunState::finished,
               failed = known.found.state == RunState::failed;
    if (!finished && !failed) {
      if (!known.run.lacks.empty()) ++seen.absent;
      continue;
    }
    ++(finished ? seen.finished : seen.failed);
    ++seen.by_node[known.found.node];
    done += known.share;
    if (!first || known.written < first->written) first = &known;
  }
  if (first && done > first->share) {
    const std::chrono::duration<double> since = fs::file_time_type::clock::now() - first->written;
    seen.seconds_left = since.count() * (static_cast<double>(kinds_) - done) / (done - first->share);
  }
  return seen;
}

}  // namespace kreisel::core
