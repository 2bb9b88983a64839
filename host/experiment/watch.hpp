// watch.hpp - how far an experiment is, told by its records alone, whoever makes them and wherever.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/attempt.hpp"
#include "experiment/runner.hpp"

namespace kreisel::core {

struct Seen {
  std::size_t runs = 0, finished = 0, failed = 0,
              absent = 0;              ///< distinct ones; absent: for want of a mesh file
  std::optional<double> seconds_left;  ///< at the pace since the first record; empty before the second
  std::map<std::string, std::size_t> by_node;  ///< finished and failed ones by the node that made them

  [[nodiscard]] bool over() const { return finished + failed + absent == runs; }
};

/// "12 of 84 runs, 1 failed; about 3 min left; node1 7, node2 5".
[[nodiscard]] std::string text_of(const Seen& seen);

class Watch {
 public:
  /// @throws InputError  a record that cannot be read
  Watch(const Experiment& experiment, const std::filesystem::path& results);

  /// Reads again what was not finished at the last look: a run that failed may be made once more.
  [[nodiscard]] Seen look();

 private:
  struct Known {
    PlannedRun run;
    double share = 0;  ///< of the work of its kind
    OnRecord found = {};
    std::filesystem::file_time_type written = {};
  };
  std::vector<Known> runs_;
  std::size_t kinds_ = 0;
};

}  // namespace kreisel::core
