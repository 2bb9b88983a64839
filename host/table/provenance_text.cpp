#include "table/provenance_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <set>

namespace kreisel::core {
namespace {

/// "3", or "3 to 5".
template <class T>
std::string range_text(const std::set<T>& values) {
  const T& least = *values.begin();
  const T& most = *values.rbegin();
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

}  // namespace

std::string provenance_text(const Runs& runs) {
  constexpr std::size_t of_day = 10;  // 2026-11-28 of 2026-11-28T23:48:14Z
  std::set<std::string> devices, commits, days;
  std::set<double> loads;
  std::set<std::size_t> samples;
  std::size_t recorded = 0;
  // A run that failed before it opened the device knows the day alone, or nothing.
  const auto note = [](std::set<std::string>& into, const nlohmann::json& value, std::size_t length) {
    if (value.is_string() && !value.get<std::string>().empty())
      into.insert(value.get<std::string>().substr(0, length));
  };
  for (const RecordedRun* run : runs) {
    if (!run->record) continue;
    ++recorded;
    note(devices, run->at("device"), std::string::npos);
    note(commits, run->at("commit"), std::string::npos);
    note(days, run->at("provenance.started"), of_day);
    if (const auto load = run->number("provenance.load")) loads.insert(std::round(10 * *load) / 10);
    if (run->has_result() && run->at("samples").is_array()) samples.insert(run->at("samples").size());
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
