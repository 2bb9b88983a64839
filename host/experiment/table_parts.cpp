#include "experiment/table_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiment/run_text.hpp"

namespace kreisel {
namespace {

double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - std::floor(at)) * (sorted[high] - sorted[low]);
}

}  // namespace

double half_interquartile_range(const std::vector<Seconds>& samples) {
  std::vector<double> sorted;
  for (const Seconds& sample : samples) sorted.push_back(sample.solve);
  std::sort(sorted.begin(), sorted.end());
  return sorted.size() < 2 ? 0 : (quantile(sorted, 0.75) - quantile(sorted, 0.25)) / 2;
}

std::string seconds_text(const RecordSummary& record) {
  const double median = record.median.solve;
  const int digits = median < 1 ? 3 : median < 100 ? 2 : 1;
  if (record.samples.size() < 2) return fmt::format("{:.{}f}", median, digits);
  return fmt::format("{:.{}f} ± {:.{}f}", median, digits, half_interquartile_range(record.samples), digits);
}

bool has_result(const RecordedRun& run) { return run.record && run.record->error.empty(); }

bool is_optimal(const RecordedRun& run) { return has_result(run) && run.record->termination == "optimal"; }

std::string termination_text(const RecordedRun& run) {
  if (!run.record) return "not run";
  return run.record->error.empty() ? run.record->termination : "error";
}

std::string provenance_text(const std::vector<RecordedRun>& runs) {
  std::set<std::string> devices, commits;
  std::set<std::size_t> samples;
  for (const RecordedRun& run : runs) {
    if (!has_result(run)) continue;
    devices.insert(run.record->device);
    commits.insert(run.record->commit);
    samples.insert(run.record->samples.size());
  }
  if (samples.empty()) return "no records yet";
  const std::size_t least = *samples.begin(), most = *samples.rbegin();
  const std::string count = least == most ? fmt::format("{} sample{} each", most, most == 1 ? "" : "s")
                                          : fmt::format("{} to {} samples each", least, most);
  return fmt::format("device {}; commit {}; {}", fmt::join(devices, ", "), fmt::join(commits, ", "), count);
}

std::string grid_text(const RecordedRun& run) {
  GridSpec grid = run.run.config.grid;
  if (!grid.cells && has_result(run)) grid.cells = run.record->grid;
  return grid_text(grid);
}

}  // namespace kreisel
