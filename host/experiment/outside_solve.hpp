// outside_solve.hpp - a solve that may take so much memory and time, and no more.
#pragma once

#include "experiment/attempt.hpp"

namespace kreisel::core {

/// Has `bench`, which lies beside this program, make the run and write its record; it is ended where it takes
/// more than the run's limits. [Limits]
class OutsideSolve final : public Attempt {
 public:
  explicit OutsideSolve(const PlannedRun& run);
  ~OutsideSolve() override;

  /// @throws InputError  it met a limit, or what `bench` says
  void run(const Control& control) override;
  [[nodiscard]] bool whole() const override { return whole_; }
  [[nodiscard]] bool converged() const override { return converged_; }
  [[nodiscard]] std::string text() const override;
  void keep() override;

 private:
  const PlannedRun& run_;
  std::filesystem::path partial_;  ///< the record, beside its final name
  bool whole_ = false, converged_ = false;
};

}  // namespace kreisel::core
