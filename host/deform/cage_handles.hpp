// cage_handles.hpp - the corners of a cage as handles.
#pragma once

#include <memory>

#include "deform/biharmonic_weights.hpp"
#include "deform/handles.hpp"

namespace kreisel::core {

/// A cage and how each node of its grid goes along with each handle.
struct WeightedCage {
  Cage cage;
  BiharmonicWeights biharmonic;
};

/// Of a mesh, in the middle of its box. @param level  of the cage's cells  @param fine  of its grid's, >=
/// level
/// @throws Interrupted
[[nodiscard]] std::shared_ptr<const WeightedCage> weighted_cage(const TriangleMesh& mesh, int level, int fine,
                                                                const Control& control = {});

/// Corners of a cage with bounded biharmonic weights, tri-linear within a cell of its grid. [SpinIt, s. 6]
class CageHandles final : public Handles {
 public:
  explicit CageHandles(std::shared_ptr<const WeightedCage> of) : of_(std::move(of)) {}

  [[nodiscard]] std::size_t count() const override { return of_->cage.handles().size(); }
  [[nodiscard]] HandleWeights at(const Vec3& x) const override;
  /// Mean square of the second differences from node to node, in units of a fourth of the cage's longest
  /// side, as those of a lattice are.
  [[nodiscard]] Eigen::MatrixXd bending() const override;

 private:
  std::shared_ptr<const WeightedCage> of_;
};

}  // namespace kreisel::core
