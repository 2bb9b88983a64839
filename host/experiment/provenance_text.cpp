#include "experiment/provenance_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <set>

namespace kreisel::core {
namespace {

/// What the three kinds of records have in common.
struct Origin {
  std::string device, commit, day;
  std::optional<double> load;
};

template <class Summary>
Origin origin(const Summary& summary) {
  constexpr std::size_t of_day = 10;  // 2026-11-28 of 2026-11-28T23:48:14Z
  return {summary.device, summary.commit, summary.started.substr(0, of_day), summary.load};
}

std::optional<Origin> origin_of(const RecordedRun& run) {
  if (run.nest) return origin(*run.nest);
  if (run.map) return origin(*run.map);
  if (run.simulation) return origin(*run.simulation);
  if (run.record) return origin(*run.record);
  return std::nullopt;
}

/// "3", or "3 to 5".
template <class T>
std::string range_text(const std::set<T>& values) {
  const T& least = *values.begin();
  const T& most = *values.rbegin();
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

}  // namespace

std::string provenance_text(const std::vector<RecordedRun>& runs) {
  std::set<std::string> devices, commits, days;
  std::set<double> loads;
  std::set<std::size_t> samples;
  std::size_t recorded = 0;
  for (const RecordedRun& run : runs) {
    const std::optional<Origin> origin = origin_of(run);
    if (!origin) continue;
    ++recorded;
    // A run that failed before it opened the device knows the day alone, or nothing.
    if (!origin->device.empty()) devices.insert(origin->device);
    if (!origin->commit.empty()) commits.insert(origin->commit);
    if (!origin->day.empty()) days.insert(origin->day);
    if (origin->load) loads.insert(std::round(10 * *origin->load) / 10);
    if (run.record && run.record->error.empty()) samples.insert(run.record->samples.size());
  }
  if (recorded == 0) return "no records yet";
  std::string text = fmt::format("device {}; commit {}", fmt::join(devices, ", "), fmt::join(commits, ", "));
  if (!days.empty()) text += "; " + range_text(days);
  if (!loads.empty()) text += "; load " + range_text(loads);
  if (!samples.empty())
    text += fmt::format("; {} sample{} each", range_text(samples), *samples.rbegin() == 1 ? "" : "s");
  if (recorded < runs.size()) text += fmt::format("; {} of {} runs", recorded, runs.size());
  return text;
}

}  // namespace kreisel::core
