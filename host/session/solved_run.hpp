// solved_run.hpp - a question answered, with all that its part is made from.
#pragma once

#include <memory>
#include <string>

#include "session/result.hpp"
#include "session/session.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {

/// The stages of a session -> solver, repeated; and where they are asked for, what would help where that is
/// infeasible, and the certificate.
class SolvedRun {
 public:
  /// Makes the stages. @throws InputError, Interrupted
  SolvedRun(Session& session, const RunConfig& config, const Control& control = {},
            Along rays = Along::own_axis);

  /// Solves, as often as asked; says what cannot be met where that is so.
  /// @throws InputError   settings that do not fit
  /// @throws Interrupted  before there was a result
  /// @throws MemoryError  the solver has too little
  void solve(const Control& control = {}) {
    decide(control);
    explain(control);
  }
  /// The first half of that: whether and how, not why not.
  void decide(const Control& control = {});
  /// The other half: what cannot be met, where the result is infeasible. May take as long as many solves.
  void explain(const Control& control = {});
  /// Where the result is infeasible: what would help. May take many solves. @throws Interrupted
  void look_for_remedies(const Control& control = {});
  /// Bounds what there is to gain, to result.config.certify. Where that finds a better interior than a solver
  /// that can start anywhere, has it go on from there. @throws Interrupted
  void certify(const Control& control = {});
  /// All three, as far as the configuration asks for them.
  void complete(const Control& control = {});

  [[nodiscard]] const Body& body() const { return *stages_.body; }
  [[nodiscard]] const Problem& problem() const { return *stages_.problem; }
  [[nodiscard]] const Stages& stages() const { return stages_; }
  [[nodiscard]] const MassModel& mass() const { return stages_.mass; }
  [[nodiscard]] Task task() const { return stages_.task(stop_); }
  /// The same with other masses. @param mass  outlives the task
  [[nodiscard]] Task task_with(const MassModel& mass) const { return stages_.task_with(mass, stop_); }
  /// Whether the interior is cut by a quadric, not made of voxels.
  [[nodiscard]] bool exact() const { return stages_.domain->exact.has_value(); }
  [[nodiscard]] const SolverEntry& solver() const { return *solver_; }
  [[nodiscard]] const SolverOptions& options() const { return options_; }
  [[nodiscard]] const std::stop_token& stop() const { return stop_; }
  /// @throws Interrupted  when a stop was asked for
  void stop_if_asked() const {
    if (stop_.stop_requested()) throw Interrupted();
  }
  /// Since the run began, without the certificate.
  [[nodiscard]] double seconds() const { return whole_.seconds() - certifying_; }

  RunResult result;  ///< its part: nothing yet

 private:
  void deform(Session& session, const Control& control, Along rays);
  void describe_run(const Provenance& provenance);
  void go_on_from_the_certificate();
  void repeat_solve(const Control& control);

  Stopwatch whole_;
  std::stop_token stop_;
  const SolverEntry* solver_;
  SolverOptions options_;
  RunConfig asked_;  ///< of the body of the stages
  Stages stages_;
  double setup_seconds_ = 0, certifying_ = 0;
};

}  // namespace kreisel::core
