// separation.hpp - the quadrics that separate what is asked of a body from all its interiors, as rows that a
// motion must meet.
#pragma once

#include <optional>
#include <vector>

#include "deform/handle_motion.hpp"
#include "deform/nearest_point.hpp"
#include "deform/shape.hpp"
#include "solve/dual.hpp"

namespace kreisel::core {

/// What of a shape's interiors comes nearest to what is asked. Body units.
struct Separated {
  double missed = 0;  ///< by the interior that misses least, of its worst row
  /// Of all quadrics so far, the most by which any still separates; negative: none does, with so much to
  /// spare.
  double worst = 0;
  HandleRows rows;  ///< about the handles u of the shape: where they are met, no quadric so far separates
};

/// Every quadric that separated a shape from what is asked, by the multipliers of its rows. All are kept and
/// looked at anew in every shape: with the newest alone a search swings to and fro. [docs/deformation.md]
class Separation {
 public:
  /// @param body  undeformed  @param problem  outlives it  @param margin  by how much more than not separate
  /// they must, body units
  Separation(const Body& body, const Problem& problem, double margin, std::stop_token stop);

  /// @param also  what the problem asks beyond its constraints, too
  /// @param u     of the handles: the shape is motion.moved(u)
  [[nodiscard]] Separated look(const Shape& shape, const HandleMotion& motion, const Eigen::MatrixX3d& u,
                               bool also);

  /// The slope of the problem's least value over all interiors of a shape, in the handles, and that value.
  struct Value {
    double value;
    Eigen::MatrixX3d slope;
  };
  /// Nothing where no interior meets the constraints.
  [[nodiscard]] std::optional<Value> value(const Shape& shape, const HandleMotion& motion) const;

  [[nodiscard]] std::size_t size() const { return cuts_.size(); }
  void forget() { cuts_.clear(); }

 private:
  [[nodiscard]] LinearConstraints asked_of(const Shape& shape) const;
  [[nodiscard]] Eigen::MatrixX3d slope_of(const Moments& q, const Shape& shape,
                                          const HandleMotion& motion) const;

  const Problem* problem_;
  double margin_;
  std::stop_token stop_;
  std::optional<Water> water_;
  Moments submerged_before_ = Moments::Zero();
  Moments also_near_;  ///< of interiors like this what is asked beyond the constraints is made rows
  std::vector<Eigen::VectorXd> cuts_;
};

}  // namespace kreisel::core
