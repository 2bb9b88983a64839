// fairness.hpp - how alike the faces of a die come up, and where its centre of mass must be for it.
#pragma once

#include <vector>

#include "body/resting.hpp"

namespace kreisel::core {

/// Of the faces on which the solid lies stably, those aside that hardly ever come up. A face that comes up
/// with probability p is waited for 1 / p throws. The loss is the mean of these waits, in units of that of a
/// fair die, less one: 0 where all faces come up alike, large where one hardly ever does. A sum of squares
/// would let one of two small faces go to please the other. [probabilities: Goldberg et al. 1999; without a
/// bounce, as on felt]
///
/// Between places at which the body begins to roll another way the loss is smooth; there it may jump.
class Fairness {
 public:
  /// @param start  the solid's centre of mass, inside
  Fairness(ConvexHull hull, const Vec3& start);
  Fairness(const Fairness&) = delete;
  Fairness& operator=(const Fairness&) = delete;

  [[nodiscard]] double loss(const Vec3& centre) const;
  /// Of the loss, as long as the body rolls as it does at this centre.
  [[nodiscard]] Vec3 gradient(const Vec3& centre) const;
  /// How often each face comes up: 0 where the body does not stay on it.
  [[nodiscard]] std::vector<double> shares(const Vec3& centre) const;
  /// The centre of least loss that Nelder's and Mead's simplex finds from the start.
  [[nodiscard]] Vec3 fairest() const;

 private:
  [[nodiscard]] bool is_inside(const Vec3& p) const;

  ConvexHull hull_;
  Grounds grounds_;
  Vec3 start_;
  std::vector<std::size_t> faces_;  ///< which grounds they are
};

}  // namespace kreisel::core
