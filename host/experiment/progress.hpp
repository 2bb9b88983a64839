// progress.hpp - one updating line on a terminal while an experiment runs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "experiment/experiment.hpp"

namespace kreisel::core {

/// A run to come: what it is called, which are like it, and how much work it is beside those.
struct Effort {
  std::string text, kind;
  double weight = 1;
};
[[nodiscard]] Effort effort_of(const ExperimentRun& run);

/// Guesses how long runs take from those that are over.
class Estimate {
 public:
  void finished(const Effort& run, double seconds);

  /// Seconds of a run still to come; empty before the first one is over.
  [[nodiscard]] std::optional<double> seconds(const Effort& run) const;

 private:
  struct Spent {
    double seconds = 0, weight = 0;
  };
  std::map<std::string, Spent> by_kind_;
  Spent all_;
};

/// "12 s", "3 min", "2 h 05 min".
[[nodiscard]] std::string duration_text(double seconds);

/// Draws "[3/28] ellipsoid 80x52x51 voxel ipopt: step ... 12 s, about 3 min left" once a second, and a line
/// for each run that is over. Where `out` is not a terminal, it writes nothing but what it is to tell().
class ProgressLine {
 public:
  /// @param runs  what will run, in order
  ProgressLine(std::FILE* out, std::vector<Effort> runs);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void begin(std::size_t index);
  void step(const std::string& text);
  /// The run that began last is over; returns its wall seconds.
  /// @param counts  whether estimates may rest on it; a run that failed was shorter than its like
  double end(bool counts);
  /// A line that stays. Only on a terminal.
  void note(const std::string& line);
  /// A line that stays, wherever it goes.
  void tell(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  void tick(const std::stop_token& stop);
  void draw();
  void erase();
  [[nodiscard]] double elapsed() const;
  [[nodiscard]] std::string left() const;

  std::FILE* out_;
  bool terminal_;
  std::vector<Effort> runs_;
  Estimate estimate_;
  std::mutex mutex_;  ///< guards everything below, and the terminal
  std::condition_variable_any wake_;
  std::size_t index_ = 0;
  bool running_ = false;
  Clock::time_point began_{};
  std::string step_;
  std::jthread ticker_;  ///< last: joined before the rest goes
};

}  // namespace kreisel::core
