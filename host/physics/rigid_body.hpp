// rigid_body.hpp - a rigid body on the ground in one point, and its equations of motion. [docs/physics.md]
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "body/moments.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// How the tip, a point of the body, touches the ground: free to glide without friction on a plane that it
/// cannot leave, held in place (Lagrange's top), or not at all, in free fall.
enum class Contact { gliding, held, free };

inline constexpr std::array<std::pair<Contact, std::string_view>, 3> contacts = {
    {{Contact::gliding, "gliding"}, {Contact::held, "held"}, {Contact::free, "free"}}};

[[nodiscard]] inline std::string_view name_of(Contact contact) {
  return contacts[static_cast<std::size_t>(contact)].second;
}

/// Everything that a motion depends on. Body frame and units (units.hpp), gravity 1.
///
/// All contacts have the same Hamiltonian of the vertical u and the angular momentum m, in body axes:
///     H = m . K(u)^-1 m / 2 + p . u,   K = I + (p x u)(p x u)^T / M (gliding) or I,
///     m' = m x w + u x dH/du,   u' = u x w,   w = dH/dm = K^-1 m.
/// Gliding, the horizontal velocity of the centre of mass is conserved and left out; what remains of it is
/// the height p . u / M.
struct RigidBody {
  Eigen::Matrix3d inertia;  ///< held: about the tip; else about the centre of mass
  Vec3 lever;               ///< p: first moments about the tip; free: zero
  double per_mass = 0;      ///< gliding: 1 / M; else 0
};

/// @param s  about the tip, the origin
[[nodiscard]] RigidBody make_rigid_body(const Moments& s, Contact contact);

/// Of a turning body.
struct BodyState {
  Eigen::Vector4d attitude = Eigen::Vector4d::UnitW();  ///< quaternion x, y, z, w: body axes -> space
  Vec3 up = Vec3::UnitZ();                              ///< u: the vertical in body axes
  Vec3 momentum = Vec3::Zero();                         ///< m, in body axes
};

/// Body z tilted from the vertical by `tilt` (radians), between its x and y axes, so that neither lateral
/// mode is left out; turning at `spin` about body z.
[[nodiscard]] BodyState tilted_start(const RigidBody& body, double spin, double tilt);

/// The same tilt, of a free body from its angular momentum, which is that of `spin` about body z. `up` is its
/// direction.
[[nodiscard]] BodyState free_start(const RigidBody& body, double spin, double tilt);

/// Angular velocity in body axes.
[[nodiscard]] Vec3 angular_velocity(const RigidBody& body, const Vec3& up, const Vec3& momentum);

/// Time derivatives of a state.
[[nodiscard]] BodyState derivative(const RigidBody& body, const BodyState& state);

/// H, conserved.
[[nodiscard]] double energy(const RigidBody& body, const BodyState& state);

/// Angular momentum about the vertical, conserved.
[[nodiscard]] inline double vertical_momentum(const BodyState& state) { return state.up.dot(state.momentum); }

/// Force of the ground on a gliding tip, in weights of the body; negative: it would have to pull.
[[nodiscard]] double ground_force(const RigidBody& body, const BodyState& state);

/// Angle between body z and the vertical, radians.
[[nodiscard]] double tilt_of(const BodyState& state);

}  // namespace kreisel::core
