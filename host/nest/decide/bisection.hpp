// bisection.hpp - the published scale search, on any feasibility test.
#pragma once

#include "nest/decide/scale_search.hpp"

namespace kreisel::core::nest {

/// Takes feasibility for monotonic: valid below some scale, invalid above, 0 valid. Halves the bracket until
/// it is narrower than the tolerance and returns the lower, valid end; stops when the upper end is no more
/// than `abort_below`. Where feasibility is not monotonic it may return any scale at which it changes, or
/// miss all (0). [Nest, s. 6 and 7.2]
class Bisection : public ScaleSearch {
 public:
  explicit Bisection(std::unique_ptr<Feasibility> test) : test_(std::move(test)) {}

  [[nodiscard]] std::string_view name() const override { return test_->name(); }
  using ScaleSearch::search;
  [[nodiscard]] FoundScale search(const Placement& placement, const SearchLimits& limits) override;

 private:
  std::unique_ptr<Feasibility> test_;
};

}  // namespace kreisel::core::nest
