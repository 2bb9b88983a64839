// stand.hpp - the standing problem. [SpinIt, end of s. 4; RayRep, s. 2]
#pragma once

#include "body/support_polygon.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// What stays when a body is to stand.
struct Base {
  SupportPolygon polygon;  ///< body frame and units, as the rest
  double ground = 0;       ///< z of the lowest point
  double height = 0;       ///< of the whole body

  /// What is no higher belongs to the base.
  [[nodiscard]] double rim() const { return ground + 0.01 * height; }

  /// Tangent of the smallest angle over the polygon's edges by which the body must be tilted to topple;
  /// negative when the centre of mass c is outside.
  [[nodiscard]] double tangent(const Vec3& c) const { return polygon.inside(c.head<2>()) / (c[2] - ground); }
};

/// Minimise c_z with the centre of mass over the base.
///
/// centre  over the base's centroid: sx = p_x s1, sy = p_y s1
/// inside  n_i . (sx, sy) <= (d_i - margin) s1 for every edge of the base
///
/// c_z = sz / s1 is linear-fractional and the optimal cavity is what lies above a plane through the final
/// centre of mass, so rays are filled from below.
class Stand final : public Problem {
 public:
  /// @param margin  body units; nothing: over the centroid
  Stand(Base base, std::optional<double> margin);

  [[nodiscard]] std::string_view name() const override { return "stand"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::fractional; }
  [[nodiscard]] Traits traits() const override { return {Filling::from_below}; }
  [[nodiscard]] double value(const Moments& s) const override { return s[SZ] / s[S1]; }
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] std::optional<Ratio> ratio() const override;
  [[nodiscard]] std::optional<double> fixed_below() const override { return base_.rim(); }
  /// Of the points that the centre of mass may be over, the one nearest to p. Body frame and units.
  [[nodiscard]] Vec2 nearest_target(const Vec2& p) const {
    return margin_ ? allowed_.nearest(p) : base_.polygon.centroid;
  }

  [[nodiscard]] double pose_loss(const Moments& s) const override {
    return -base_.tangent(centre_of_mass(s));
  }
  /// Stands when the centre of mass is inside the base, seen from above.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  Base base_;
  std::optional<double> margin_;
  SupportPolygon allowed_;  ///< the base less the margin
  LinearConstraints constraints_;
};

/// Maximise the angle at which the body topples: the largest tau = tan(angle) for which the rows
/// n_i . (sx, sy) + tau sz <= d_i s1 can be met, heights above the ground.
///
/// For a fixed tau they are linear. One step solves for the smallest margin t of the rows; the tilt of its
/// solution, never less than tau, is the tau of the next. That is Dinkelbach's rule for max-min ratios: as
/// exact as bisection, and superlinear. [Dinkelbach 1967; Crouzeix, Ferland, Schaible 1985]
class MaxTilt final : public Problem {
 public:
  MaxTilt(Base base, double tau);

  [[nodiscard]] std::string_view name() const override { return "stand"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::fractional; }
  [[nodiscard]] Traits traits() const override { return {Filling::from_below}; }
  [[nodiscard]] Goal goal() const override { return Goal::margin; }
  /// Minus the tangent of the toppling angle; gradient and Hessian are those of the nearest edge's.
  [[nodiscard]] double value(const Moments& s) const override;
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] std::optional<Ratio> ratio() const override;
  [[nodiscard]] std::optional<double> fixed_below() const override { return base_.rim(); }
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments& s) const override;
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  [[nodiscard]] const SupportPolygon::Edge& nearest(const Moments& s) const;
  [[nodiscard]] Moments height_form() const;  ///< first moment of the height above the ground, as a form of s

  Base base_;
  double tau_;
  LinearConstraints constraints_;
};

/// A body that does not rest where it is to stand: no interior helps.
class Baseless final : public Problem {
 public:
  explicit Baseless(std::string body) : body_(std::move(body)) {}

  [[nodiscard]] std::string_view name() const override { return "stand"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::fractional; }
  [[nodiscard]] Traits traits() const override { return {Filling::from_below}; }
  [[nodiscard]] double value(const Moments& s) const override { return s[SZ] / s[S1]; }
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] const LinearConstraints& constraints() const override { return none_; }
  [[nodiscard]] std::string impossible() const override;
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  std::string body_;
  LinearConstraints none_{decltype(LinearConstraints::matrix)(0, 10), {}, {}, {}};
};

enum class StandTarget { centre, inside, max_tilt };

struct StandSettings {
  StandTarget target = StandTarget::centre;
  /// From the edge of the base, of `inside`; nothing: 0.01 L, at most half of what the centroid has.
  std::optional<double> margin_mm;
  /// Per cent of the height within which vertices touch the ground; nothing: what it rests on,
  /// resting_polygon().
  std::optional<double> base_percent;
};

[[nodiscard]] Fields<StandSettings> stand_fields();
/// @param settings  StandSettings
/// @throws InputError  a margin for another target, or no base of that share
std::unique_ptr<Problem> make_stand(const Settings& settings, const Body& body);

}  // namespace kreisel::core
