// keep_out.hpp - parts of the outer surface that the cut must not touch: a face, a hand, lettering.
#pragma once

#include <vector>

#include "nest/decide/nesting.hpp"

namespace kreisel::core::nest {

/// A ball; what of A's surface lies in it stays whole. Nesting units.
struct KeepOut {
  Vec3 centre = Vec3::Zero();
  double radius = 0;  ///< > 0
};

/// The surface in each ball, as the vertices of all triangles with a corner in it.
class KeepOuts {
 public:
  KeepOuts() = default;
  /// @throws InputError  a radius that is not positive, or a ball without a vertex of A
  KeepOuts(const Nesting& nesting, const std::vector<KeepOut>& balls);
  /// The same of another surface than A's, nesting units: where A is the space inside it.
  KeepOuts(const Nesting& nesting, const std::vector<KeepOut>& balls, const TriangleMesh& surface);

  /// Whether the plane parts, or touches, the surface in a ball.
  [[nodiscard]] bool touched(const Cut& cut) const;

 private:
  std::vector<std::vector<Vec3>> surfaces_;
};

}  // namespace kreisel::core::nest
