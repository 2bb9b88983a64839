// die.hpp - a die as fair as its shape allows.
#pragma once

#include <vector>

#include "body/resting.hpp"
#include "problem/balance.hpp"

namespace kreisel::core {

/// How often each face comes up: the shares of the ways of lying that are stable, their sum 1. @param centre
/// of mass. [Goldberg et al. 1999] Without a bounce: what a die does on felt.
[[nodiscard]] std::vector<double> face_shares(const ConvexHull& hull, const Vec3& centre);

/// The centre of mass for which the faces that are stable at `start` come up as alike as can be: least sum of
/// squares of their shares less the mean, by Nelder's and Mead's simplex. Inside the hull.
[[nodiscard]] Vec3 fairest_centre(const ConvexHull& hull, const Vec3& start);

/// Moves the centre of mass c from the solid's c0 towards the fairest c* as far as an interior can, and then
/// keeps as much material as it can there.
///
/// A sequence of two: maximise t with c on the line c0 + t (c* - c0), which is linear-fractional; then the
/// mass at the t that was reached, 1 at the most (Balance).
class Die final : public Problem {
 public:
  /// @param hull  body frame and units  @param solid  of the body
  Die(ConvexHull hull, const Moments& solid);

  [[nodiscard]] std::string_view name() const override { return "die"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::fractional; }
  [[nodiscard]] Traits traits() const override { return {Filling::either_end}; }
  /// Minus t.
  [[nodiscard]] double value(const Moments& s) const override { return -numerator_.dot(s) / s[S1]; }
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] const LinearConstraints& constraints() const override { return line_.constraints(); }
  [[nodiscard]] std::optional<Ratio> ratio() const override;
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments& s) const override;
  [[nodiscard]] const Vec3& start() const { return start_; }
  [[nodiscard]] const Vec3& fairest() const { return fairest_; }

  /// Fair when the faces come up more alike than the solid's, or the solid's are as alike as the shape
  /// allows.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  ConvexHull hull_;
  Vec3 start_, fairest_;  ///< c0 and c*
  Balance line_;
  Moments numerator_ = Moments::Zero();  ///< t s1, as a form of s
};

/// It has no settings.
std::unique_ptr<Problem> make_die(const Settings&, const Body& body);
[[nodiscard]] std::optional<Vec3> rays_of_die(const Settings&, const Body& body);

}  // namespace kreisel::core
