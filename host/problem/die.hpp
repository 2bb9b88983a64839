// die.hpp - a die as fair as its shape allows.
#pragma once

#include <memory>

#include "problem/fairness.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// Maximise how far the centre of mass c goes along a way: t = along . (c - from) / |along|^2.
/// Linear-fractional.
class Reach : public Problem {
 public:
  Reach(const Vec3& from, const Vec3& along);

  [[nodiscard]] std::string_view name() const override { return "die"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::fractional; }
  [[nodiscard]] Traits traits() const override { return {Filling::either_end}; }
  /// Minus t.
  [[nodiscard]] double value(const Moments& s) const override { return numerator_.dot(s) / s[S1]; }
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] std::optional<Ratio> ratio() const override;

 private:
  Moments numerator_ = Moments::Zero();  ///< -t s1, as a form of s
};

/// Where the centre of mass of a die is to go: from the solid's.
struct DieGoal {
  std::shared_ptr<const Fairness> fairness;
  Vec3 start, fairest;  ///< the same where the way is too short to be seen
};

/// Moves the centre of mass to where the faces come up most alike (Fairness), or as near to that in effect as
/// an interior can; and then keeps as much material as it can there.
///
/// What is asked is how far interiors reach towards the fairest centre: maximise t, the share of the way that
/// c has gone along it; linear-fractional. A sequence follows, each of its steps as simple: the farthest on
/// the straight way; from the best there, where the fairest is out of reach, along the boundary of what can
/// be reached: as far down the gradient of the loss as a box around the best allows, which halves where that
/// is no better; at last the most material at the best that was found (Balance). Of centres of mass what lies
/// between two that can be reached can be reached, so that steps may be shortened. It ends where no small
/// change of the interior makes the die fairer.
class Die final : public Reach {
 public:
  /// @param hull  body frame and units  @param solid  of the body
  Die(ConvexHull hull, const Moments& solid);

  [[nodiscard]] const LinearConstraints& constraints() const override { return none_; }
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments& s) const override;
  /// Where the centre of mass had best be, within reach or not.
  [[nodiscard]] const Vec3& fairest() const { return goal_.fairest; }

  /// A die when its faces come up more alike than the solid's, or as alike as the shape allows.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  explicit Die(DieGoal goal);

  DieGoal goal_;
  LinearConstraints none_{decltype(LinearConstraints::matrix)(0, 10), {}, {}, {}};
};

/// It has no settings.
std::unique_ptr<Problem> make_die(const Settings&, const Body& body);
[[nodiscard]] std::optional<Vec3> rays_of_die(const Settings&, const Body& body);

}  // namespace kreisel::core
