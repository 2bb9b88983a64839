// compare.hpp - two sets of records, run by run: two commits, two machines, two settings.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "table/sheet.hpp"

namespace kreisel::core {

/// What two runs are compared by.
struct TimedRun {
  std::string kind;                           ///< run, map, nesting
  std::map<std::string, std::string> config;  ///< as describe() gives it
  std::string error, ending;                  ///< of a run that failed; how a solve or search ended
  std::vector<double> seconds;                ///< of each timed solve, sweep or search
  std::optional<double> objective;            ///< f; of a nesting the scale
};

/// Every record in a folder and those below it, or the one of that name. Simulations are none of these: left
/// out.
/// @throws InputError  nothing there, no records, one that cannot be read
[[nodiscard]] std::vector<TimedRun> timed_runs(const std::filesystem::path& folder);

/// One run of A and the same of B.
struct Pair {
  std::string name;                  ///< what tells it from the others
  std::optional<double> ratio;       ///< of medians, B / A; none where one failed or took no time
  std::optional<double> spread;      ///< of the ratio: half its interquartile range; none of single samples
  std::optional<double> difference;  ///< of objectives, B - A, in parts of A's
  std::string endings;               ///< where they differ: "optimal, failed"

  /// Whether B takes more than `limit` times as long, the spread put in B's favour.
  [[nodiscard]] bool above(double limit) const { return ratio && *ratio - spread.value_or(0) > limit; }
};

struct Comparison {
  std::vector<Pair> pairs;
  std::vector<std::string> only_a, only_b;  ///< names of runs that have no counterpart
  /// Fields that tell A from B as a whole, and not one run from another: "ipopt.linear_solver: mumps, arrow".
  std::vector<std::string> across;

  /// Geometric mean of the ratios; none where there is none.
  [[nodiscard]] std::optional<double> mean() const;
};

/// Runs are the same when all that describes them is, but for device and precision, how often a solve is
/// timed, and fields that have one value in all of A and another in all of B. Of several such runs the first.
[[nodiscard]] Comparison compare(const std::vector<TimedRun>& a, const std::vector<TimedRun>& b);

/// @param limit  pairs above it are marked
[[nodiscard]] Tables table_of(const Comparison& comparison, const std::optional<double>& limit);

}  // namespace kreisel::core
