#include "experiment/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "error.hpp"
#include "record/records_in.hpp"
#include "statistics.hpp"

namespace kreisel::core {
namespace {

using Fields = std::map<std::string, std::string>;

TimedRun timed(const Record& record) {
  constexpr std::array names = {"run", "map", "nesting"};
  TimedRun run{names[static_cast<std::size_t>(record.kind)], record.config(), record.error, "", {}, {}};
  const auto number = [&](const char* name) {
    const nlohmann::json found = record.summary.at(name);
    return found.is_number() ? std::optional(found.get<double>()) : std::nullopt;
  };
  if (!record.error.empty()) return run;
  if (record.kind != RecordKind::map) run.ending = record.summary.at("termination");
  const nlohmann::json samples = record.summary.at("samples");
  for (const nlohmann::json& sample : samples) run.seconds.push_back(sample.at("solve"));
  for (const char* name : {"seconds.sweep", "seconds.search"})
    if (const auto seconds = number(name)) run.seconds.push_back(*seconds);
  run.objective = record.kind == RecordKind::map       ? number("best.objective")
                  : record.kind == RecordKind::nesting ? number("scale")
                                                       : number("objective");
  return run;
}

/// What may differ between two machines, or says how a run is timed, but not what it is.
constexpr std::array circumstances = {"device", "precision", "repeat", "budget", "label"};

std::string value_in(const TimedRun& run, const std::string& field) {
  const auto found = run.config.find(field);
  return found == run.config.end() ? "" : found->second;
}

std::set<std::string> values_of(const std::vector<TimedRun>& runs, const std::string& field) {
  std::set<std::string> values;
  for (const TimedRun& run : runs) values.insert(value_in(run, field));
  return values;
}

std::set<std::string> fields_of(const std::vector<TimedRun>& runs) {
  std::set<std::string> fields;
  for (const TimedRun& run : runs)
    for (const auto& [field, value] : run.config) fields.insert(field);
  for (const char* field : circumstances) fields.erase(field);
  return fields;
}

/// What tells a run from others, of the fields given.
std::string identity(const TimedRun& run, const std::set<std::string>& fields) {
  std::string text = run.kind;
  for (const std::string& field : fields) text += fmt::format("\n{}={}", field, value_in(run, field));
  return text;
}

std::string name_of(const TimedRun& run, const std::set<std::string>& telling) {
  std::vector<std::string> words;
  for (const std::string& field : telling)
    if (const std::string value = value_in(run, field); !value.empty())
      words.push_back(field == "model" || field == "formulation" || field == "problem" ||
                              field == "resolution"
                          ? value
                          : field + "=" + value);
  return words.empty() ? run.kind : fmt::format("{}", fmt::join(words, " "));
}

double relative_spread(const std::vector<double>& values) {
  return half_interquartile_range(values) / median(values);
}

Pair pair_of(const TimedRun& a, const TimedRun& b, std::string name) {
  Pair pair{std::move(name), {}, {}, {}, {}};
  if (!a.seconds.empty() && !b.seconds.empty() && median(a.seconds) > 0 && median(b.seconds) > 0) {
    pair.ratio = median(b.seconds) / median(a.seconds);
    if (a.seconds.size() > 1 || b.seconds.size() > 1)
      pair.spread = *pair.ratio * std::hypot(relative_spread(a.seconds), relative_spread(b.seconds));
  }
  if (a.objective && b.objective && std::isfinite(*a.objective) && std::isfinite(*b.objective))
    pair.difference = (*b.objective - *a.objective) / std::max(std::abs(*a.objective), 1e-300);
  const auto ending = [](const TimedRun& run) { return run.error.empty() ? run.ending : "error"; };
  if (ending(a) != ending(b)) pair.endings = ending(a) + ", " + ending(b);
  return pair;
}

}  // namespace

std::vector<TimedRun> timed_runs(const std::filesystem::path& folder) {
  std::vector<TimedRun> runs;
  for (const std::filesystem::path& path : records_in(folder))
    if (const Record record = read_record(path); record.kind != RecordKind::simulation)
      runs.push_back(timed(record));
  if (runs.empty())
    throw InputError(
        fmt::format("{}: no records of runs, maps or nestings in it; expected some (*.h5)", folder.string()));
  return runs;
}

std::optional<double> Comparison::mean() const {
  double sum = 0;
  int count = 0;
  for (const Pair& pair : pairs) {
    if (!pair.ratio) continue;
    sum += std::log(*pair.ratio);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return std::exp(sum / count);
}

Comparison compare(const std::vector<TimedRun>& a, const std::vector<TimedRun>& b) {
  Comparison result;
  std::set<std::string> fields = fields_of(a);
  fields.merge(fields_of(b));
  std::set<std::string> same, telling;
  for (const std::string& field : fields) {
    const std::set<std::string> in_a = values_of(a, field), in_b = values_of(b, field);
    if (in_a.size() == 1 && in_b.size() == 1 && in_a != in_b) {
      const auto shown = [](const std::string& value) {
        return value.empty() ? std::string("default") : value;
      };
      result.across.push_back(fmt::format("{}: {}, {}", field, shown(*in_a.begin()), shown(*in_b.begin())));
      continue;
    }
    same.insert(field);
    if (in_a.size() > 1 || in_b.size() > 1) telling.insert(field);
  }
  std::map<std::string, const TimedRun*> others;
  for (const TimedRun& run : b) others.insert({identity(run, same), &run});
  std::set<std::string> seen;
  for (const TimedRun& run : a) {
    const std::string key = identity(run, same);
    if (!seen.insert(key).second) continue;
    const auto other = others.find(key);
    if (other == others.end())
      result.only_a.push_back(name_of(run, telling));
    else
      result.pairs.push_back(pair_of(run, *other->second, name_of(run, telling)));
  }
  for (const auto& [key, run] : others)
    if (!seen.contains(key)) result.only_b.push_back(name_of(*run, telling));
  return result;
}

Tables table_of(const Comparison& comparison, const std::optional<double>& limit) {
  Sheet sheet({{"run", "", "run", true},
               {"ratio", "", "B / A"},
               {"spread", "", "±"},
               {"objective_difference", "", "f, B - A"},
               {"endings", "", "ended", true},
               {"above", "", "", true}});
  for (const Pair& pair : comparison.pairs) {
    const bool above = limit && pair.above(*limit);
    Cell ratio = Cell::of(pair.ratio, "{:.3g}");
    if (above) ratio.text += " !";
    sheet.add({pair.name, ratio, Cell::of(pair.spread, "{:.2g}"), Cell::of(pair.difference, "{:.1e}"),
               pair.endings, above ? "yes" : "no"});
  }
  std::string notes;
  const auto list = [&](const std::vector<std::string>& names, const char* where) {
    for (const std::string& name : names) notes += fmt::format("only in {}: {}\n", where, name);
  };
  list(comparison.only_a, "A");
  list(comparison.only_b, "B");
  if (const auto mean = comparison.mean()) notes += fmt::format("geometric mean of B / A: {:.3g}\n", *mean);
  std::string heading;
  for (const std::string& field : comparison.across) heading += "A, B differ in " + field + "\n";
  if (!heading.empty()) heading.pop_back();
  return {{{heading, sheet, notes}},
          "B / A: medians of the solve (or sweep, or search); ±: half the interquartile range of the ratio; "
          "f: relative\n"};
}

}  // namespace kreisel::core
