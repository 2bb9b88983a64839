#include "experiment/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <utility>

#include "disjoint_sets.hpp"
#include "error.hpp"
#include "experiment/progress.hpp"
#include "parse.hpp"
#include "run/run.hpp"
#include "table/compared.hpp"

namespace kreisel::core {
namespace {

/// Runs that stay together, and what they are of all work of each kind: (kind, share).
struct Unit {
  std::vector<std::size_t> runs;
  std::vector<std::pair<std::size_t, double>> work;

  [[nodiscard]] double heaviest() const {
    double most = 0;
    for (const auto& [kind, share] : work) most = std::max(most, share);
    return most;
  }
};

struct Units {
  std::vector<Unit> all;  ///< in the order of the file
  std::size_t kinds = 0;  ///< of work
};

/// Together are those that a table compares, and those that are one run under several labels.
Units units_of(const Experiment& experiment) {
  const ComparedAs compared_as = compared_in(experiment.table, experiment.layout);
  const std::size_t count = experiment.runs.size();
  DisjointSets joined(count);
  std::unordered_map<std::string, std::uint32_t> named, compared;
  std::unordered_map<std::string, std::size_t> kinds;
  std::vector<std::size_t> kind_of(count);
  std::vector<double> weight(count), whole;
  for (std::uint32_t i = 0; i < count; ++i) {
    const ExperimentRun& run = experiment.runs[i];
    if (const std::string key = compared_as({run}); !key.empty())
      joined.join(i, compared.try_emplace(key, i).first->second);
    const auto [first, is_first] = named.try_emplace(run_name(run.run), i);
    joined.join(i, first->second);
    const Effort effort = effort_of(run);
    kind_of[i] = kinds.try_emplace(effort.kind, kinds.size()).first->second;
    whole.resize(kinds.size());
    weight[i] = is_first ? effort.weight : 0;  // it is made once
    whole[kind_of[i]] += weight[i];
  }
  Units units{{}, kinds.size()};
  std::unordered_map<std::uint32_t, std::size_t> unit_of;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [at, is_new] = unit_of.try_emplace(joined.find(i), units.all.size());
    if (is_new) units.all.emplace_back();
    Unit& unit = units.all[at->second];
    unit.runs.push_back(i);
    auto work = std::ranges::find(unit.work, kind_of[i], &std::pair<std::size_t, double>::first);
    if (work == unit.work.end()) work = unit.work.insert(work, {kind_of[i], 0.0});
    work->second += weight[i] / whole[kind_of[i]];
  }
  return units;
}

}  // namespace

Shard shard_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash != text.npos) {
    const auto number = parse<int>(text.substr(0, slash)), of = parse<int>(text.substr(slash + 1));
    if (number && of && *number >= 1 && *number <= *of)
      return {static_cast<std::size_t>(*number), static_cast<std::size_t>(*of)};
  }
  throw InputError(fmt::format("shard = '{}'; expected I/N, the I-th of N shares, 1 <= I <= N", text));
}

Experiment share_of(const Experiment& experiment, const Shard& shard) {
  Units units = units_of(experiment);
  std::ranges::stable_sort(units.all, std::ranges::greater{}, &Unit::heaviest);
  // By kind, then by shard.
  std::vector<std::vector<double>> loads(units.kinds, std::vector<double>(shard.of));
  std::vector<double> sums(shard.of);
  std::vector<std::size_t> mine;
  for (const Unit& unit : units.all) {
    // How much of the unit's kinds a shard has; among equals, how much of anything.
    const auto load = [&](std::size_t k) {
      double like = 0;
      for (const auto& [kind, share] : unit.work) like += share * loads[kind][k];
      return std::pair{like, sums[k]};
    };
    std::size_t least = 0;
    auto least_load = load(0);
    for (std::size_t k = 1; k < shard.of; ++k)
      if (const auto other = load(k); other < least_load) least = k, least_load = other;
    for (const auto& [kind, share] : unit.work) loads[kind][least] += share, sums[least] += share;
    if (least + 1 == shard.number) mine.insert(mine.end(), unit.runs.begin(), unit.runs.end());
  }
  std::ranges::sort(mine);
  Experiment part = experiment;
  part.runs.clear();
  for (const std::size_t i : mine) part.runs.push_back(experiment.runs[i]);
  return part;
}

}  // namespace kreisel::core
