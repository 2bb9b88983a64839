// attempt.hpp - one run of an experiment as it is made and kept: of any kind.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "experiment/runner.hpp"

namespace kreisel::core {

/// What the runner asks of a run, whichever kind it is. Destroyed before keep(), it leaves nothing.
class Attempt {
 public:
  Attempt() = default;
  virtual ~Attempt() = default;
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  /// @throws  whatever the run throws
  virtual void run(const Control& control) = 0;

  // Once run() has returned:
  /// False where the user stopped it before its end.
  [[nodiscard]] virtual bool whole() const = 0;
  [[nodiscard]] virtual bool converged() const = 0;
  /// What came of it, in a line.
  [[nodiscard]] virtual std::string text() const = 0;
  /// Puts it on record, and its mesh in place. @throws InputError  a disk that is full; then the old ones
  /// stay
  virtual void keep() = 0;
};

/// @param run, hooks  must outlive the attempt
[[nodiscard]] std::unique_ptr<Attempt> make_attempt(const PlannedRun& run, const RunnerHooks& hooks);

struct OnRecord {
  RunState state = RunState::missing;
  std::string node;  ///< the host that made it; empty: nobody, or it is not known
};
/// What is on disk for it. @throws InputError  a record that cannot be read
[[nodiscard]] OnRecord on_record(const PlannedRun& run);
/// The same where its record is read already. @param record  nothing: there is none
[[nodiscard]] OnRecord on_record(const PlannedRun& run, const std::optional<Record>& record);

}  // namespace kreisel::core
