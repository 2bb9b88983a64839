// float.hpp - the floating problem. [RayRep, eq. 3-5]
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "body/hydrostatics.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// The water a body floats in, and how deep.
struct Draft {
  Hydrostatics water;              ///< body frame and units
  double mass = 0;                 ///< of the displaced fluid, in solid masses: what the part must weigh
  double fluid = 1, density = 1;   ///< of the fluid and of the shell, g/cm^3
  bool one_material = true;        ///< in shell and interior, and voids are empty:
                                   ///< then any density can be asked of
  double solid_grams = 1;          ///< a solid mass
  Moments load = Moments::Zero();  ///< what is carried: its mass and first
                                   ///< moments, in solid masses
  std::optional<double> floods_at = {};  ///< heel at which water comes over a rim, radians; of a boat
  std::shared_ptr<const TriangleMesh> hull =
      {};               ///< body frame; nothing: where it comes to rest is not asked
  bool sought = false;  ///< one of several that are tried: a stable one is wanted
};

/// Minimise c_z with the centre of mass over the centre of buoyancy and the
/// part's mass that of the water it displaces: sx = c_bx m_b, sy = c_by m_b, s1
/// = m_b; all of these with what the part carries. Where the draft is one of several to choose from, the
/// centre of mass must not lie above the metacentre, either: sz <= m_b times its height. All linear: the
/// optimal cavity is what lies above a plane, so rays are filled from below.
class Float final : public Problem {
 public:
  explicit Float(const Draft& draft);

  [[nodiscard]] std::string_view name() const override { return "float"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Traits traits() const override { return {Filling::from_below}; }
  [[nodiscard]] double value(const Moments& s) const override {
    return (s[SZ] + draft_.load[SZ]) / draft_.mass;
  }
  [[nodiscard]] Moments gradient(const Moments&) const override;
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }

  /// That the centre of mass is below the metacentre, of the body as it is, with a hundredth of a length to
  /// spare.
  [[nodiscard]] LinearConstraints also_asked(const Moments& s) const override;
  /// Nothing where a stable draft is sought: that depends on the waterplane, too.
  [[nodiscard]] std::optional<Water> water() const override {
    if (draft_.sought) return std::nullopt;
    return Water{draft_.water.waterline, draft_.fluid / draft_.density};
  }

  /// Minus the metacentric height.
  [[nodiscard]] double pose_loss(const Moments& s) const override {
    return centre_of_mass(s + draft_.load)[2] - draft_.water.metacentre();
  }

  /// The densities with which the body can float at this draft, and at any.
  [[nodiscard]] std::string scope(const MassModel& mass) const override;

  /// Floats upright when mass and displaced mass agree to 1e-3, the centre of
  /// mass is within 1e-3 L of the vertical through the centre of buoyancy, and
  /// it lies below the metacentre.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;
  /// With heel and trim at rest, found by letting go (physics/rest_afloat.hpp).
  [[nodiscard]] Verdict verify_at_rest(const Moments& s, double length_mm) const override;

 private:
  Draft draft_;
  LinearConstraints constraints_;
};

/// How deep a body is to lie in the water.
struct DraftSpec {
  enum Kind {
    share,  ///< of the height, per cent
    depth,  ///< mm
    mass,   ///< g, that it displaces
    solid,  ///< as the solid body sinks
    open    ///< to be found: drafts_of()
  };
  Kind kind = share;
  double value = 60;
  bool sought = false;  ///< one of drafts_of()
};

/// A weight that is put into or onto the body, and is small beside it.
struct Load {
  double grams = 0;
  Vec3 at{0, 0, 0};  ///< model coordinates, mm
};

struct FloatSettings {
  DraftSpec draft;
  double fluid_density = 1;  ///< g/cm^3
  std::vector<Load> loads = {};
};

/// Mass and first moments of the loads: solid masses, body frame and units. The
/// others are 0.
[[nodiscard]] Moments moments_of(const std::vector<Load>& loads, const Body& body);

[[nodiscard]] Fields<FloatSettings> float_fields();
/// @param settings  FloatSettings
/// @throws InputError  a draft outside the body or left open, or a mass that
/// displaces more than the body
std::unique_ptr<Problem> make_float(const Settings& settings, const Body& body);

/// Settings with an open draft: one with each of the drafts to try, six from 25
/// to 85 % of the height. Others as they are.
[[nodiscard]] std::vector<Settings> drafts_of(const Settings& settings, const Body&);

}  // namespace kreisel::core
