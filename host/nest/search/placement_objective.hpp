// placement_objective.hpp - how large a copy nests, as a function that searches can maximise.
#pragma once

#include <memory>
#include <vector>

#include "nest/decide/feasibility.hpp"
#include "nest/decide/scale_search.hpp"
#include "nest/search/freedom.hpp"
#include "nest/search/keep_out.hpp"
#include "nest/search/objective.hpp"

namespace kreisel::core::nest {

/// Positions of a PlacementSpace, without what decides about them.
class PlacementObjective : public Objective {
 public:
  [[nodiscard]] const Space& space() const override { return placements_.space(); }
  void project(std::span<double> x) const override { placements_.project(x); }
  void place(std::span<const double> unit, std::span<double> x) const override { placements_.place(unit, x); }

  [[nodiscard]] const PlacementSpace& placements() const { return placements_; }

  /// Of the search that it asks, as ScaleSearch has them.
  [[nodiscard]] virtual std::vector<Vec3> memory() const { return {}; }
  virtual void recall(const std::vector<Vec3>&) {}

 protected:
  PlacementObjective(PlacementSpace placements, KeepOuts keep_outs)
      : placements_(std::move(placements)), keep_outs_(std::move(keep_outs)) {}

  /// The placements of all positions, and which of them touch no keep-out.
  struct Asked {
    std::vector<Placement> placements;
    std::vector<std::size_t> index;  ///< of each, among the positions
  };
  /// @param count  of the positions, which may have no numbers
  [[nodiscard]] Asked allowed(std::span<const double> positions, std::size_t count) const;

 private:
  PlacementSpace placements_;
  KeepOuts keep_outs_;
};

/// The scale is one of the position's numbers, and its value where that nests. [Nest, eq. 4, with minus
/// infinity where the text prints plus]
class ScaleInPosition final : public PlacementObjective {
 public:
  ScaleInPosition(PlacementSpace placements, KeepOuts keep_outs, Feasibility& feasibility)
      : PlacementObjective(std::move(placements), std::move(keep_outs)), feasibility_(&feasibility) {}
  [[nodiscard]] std::vector<double> values(std::span<const double> positions,
                                           std::span<const double> floors) override;

 private:
  Feasibility* feasibility_;
};

/// The largest scale at the rest of the placement. [Nest, eq. 9]
class LargestScale final : public PlacementObjective {
 public:
  /// @param abort  give a search up when it can no longer exceed its floor [Nest, s. 7.2]
  LargestScale(PlacementSpace placements, KeepOuts keep_outs, ScaleSearch& search, double upper,
               double tolerance, bool abort)
      : PlacementObjective(std::move(placements), std::move(keep_outs)),
        search_(&search),
        upper_(upper),
        tolerance_(tolerance),
        abort_(abort) {}
  [[nodiscard]] std::vector<double> values(std::span<const double> positions,
                                           std::span<const double> floors) override;

  [[nodiscard]] std::vector<Vec3> memory() const override { return search_->memory(); }
  void recall(const std::vector<Vec3>& memory) override { search_->recall(memory); }

  [[nodiscard]] std::uint64_t tests() const { return tests_; }  ///< FoundScale::tests of all searches
  [[nodiscard]] std::uint64_t aborted() const { return aborted_; }

 private:
  ScaleSearch* search_;
  double upper_, tolerance_;
  bool abort_;
  std::uint64_t tests_ = 0, aborted_ = 0;
};

}  // namespace kreisel::core::nest
