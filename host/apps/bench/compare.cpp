#include "experiment/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "error.hpp"
#include "file/write_text.hpp"

namespace kreisel::core::bench {

int compare_results(const CompareOptions& options) {
  if (options.fail_above && !(*options.fail_above > 0))
    throw InputError(fmt::format("--fail-above {}; expected a ratio > 0, such as 1.2", *options.fail_above));
  require_writable(options.csv_file, "--csv");
  const Comparison comparison = compare(timed_runs(options.a), timed_runs(options.b));
  const Tables tables = table_of(comparison, options.fail_above);
  fmt::print("{}", to_text(tables));
  if (!options.csv_file.empty()) write_text(options.csv_file, to_csv(tables));
  if (comparison.pairs.empty())
    throw InputError(
        fmt::format("{} and {} have no run in common; expected the same runs", options.a, options.b));
  if (!options.fail_above) return done;
  const auto slower = std::ranges::count_if(
      comparison.pairs, [&](const Pair& pair) { return pair.above(*options.fail_above); });
  if (slower == 0) return done;
  fmt::print(stderr, "bench: {} of {} runs of {} take more than {} times as long as in {}\n", slower,
             comparison.pairs.size(), options.b, *options.fail_above, options.a);
  return slower_than_allowed;
}

}  // namespace kreisel::core::bench
