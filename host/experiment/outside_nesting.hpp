// outside_nesting.hpp - nestings by searches that `bench` does not link: pagmo2's.
#pragma once

#include "experiment/attempt.hpp"

namespace kreisel::core {

/// Calls the program nest_baseline, which lies beside this one and writes the record. With pagmo's libraries
/// `bench` itself would no longer start in little memory.
class OutsideNesting final : public Attempt {
 public:
  explicit OutsideNesting(const PlannedRun& run) : run_(run) {}

  /// @throws InputError  the program is not there, or refuses what it is asked
  void run(const Control& control) override;
  [[nodiscard]] bool whole() const override { return whole_; }
  [[nodiscard]] bool converged() const override { return true; }
  [[nodiscard]] std::string text() const override;
  void keep() override {}  // is done

 private:
  const PlannedRun& run_;
  bool whole_ = false;
};

}  // namespace kreisel::core
