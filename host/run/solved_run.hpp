// solved_run.hpp - a run up to the optimum, with all that its part is made from.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "run/result.hpp"
#include "run/run_domain.hpp"
#include "stopwatch.hpp"

namespace kreisel {

/// Told what is under way, for progress on a terminal. May be empty.
using Progress = std::function<void(const std::string& step)>;

/// Body -> domain -> formulation -> solver, repeated; and what would help where that is infeasible, and the
/// certificate where one is asked for.
class SolvedRun {
 public:
  /// @throws InputError   bad configuration or mesh
  /// @throws Interrupted  before there was a result
  /// @throws MemoryError  the solver has too little
  explicit SolvedRun(const RunConfig& config, const Progress& progress = {});
  SolvedRun(const SolvedRun&) = delete;
  SolvedRun& operator=(const SolvedRun&) = delete;

  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const Problem& problem() const { return *problem_; }
  [[nodiscard]] const MassModel& mass() const { return mass_; }
  [[nodiscard]] Task task() { return task_with(mass_); }
  /// The same with other masses. @param mass  outlives the task
  [[nodiscard]] Task task_with(const MassModel& mass) { return {*problem_, *formulation_, mass, device_}; }
  /// Whether the interior is cut by a quadric, not made of voxels.
  [[nodiscard]] bool exact() const { return domain_.exact.has_value(); }
  [[nodiscard]] const SolverEntry& solver() const { return solver_; }
  [[nodiscard]] const SolverOptions& options() const { return options_; }
  /// Since the run began, without the certificate.
  [[nodiscard]] double seconds() const { return whole_.seconds() - certifying_; }

  RunResult result;  ///< its part: nothing yet

 private:
  void describe_run();
  void repeat_solve(double setup_seconds, const Progress& progress);
  void add_certificate();

  Stopwatch whole_;
  const SolverEntry& solver_;
  SolverOptions options_;
  device::Device device_;
  Stopwatch setup_;
  Body body_;
  std::unique_ptr<Problem> problem_;
  RunDomain domain_;
  MassModel mass_;
  std::unique_ptr<Formulation> formulation_;
  double certifying_ = 0;
};

}  // namespace kreisel
