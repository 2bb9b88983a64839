// body.hpp - a solid in its frame, with everything about it that is not designed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/axle.hpp"
#include "body/dry_space.hpp"
#include "body/frame.hpp"
#include "body/moments.hpp"
#include "body/resting.hpp"
#include "body/stem.hpp"
#include "device/device.hpp"
#include "geometry/triangle_mesh.hpp"
#include "kreisel/mending.hpp"
#include "kreisel/problem.hpp"
#include "mesh/io/length_unit.hpp"

namespace kreisel::core {

/// What the user says of a body; what is left out comes from the model, else from the defaults named here.
struct BodySpec {
  std::string model = "ellipsoid";  ///< a name of models() or debian_meshes(), or a mesh file
  std::optional<Vec3> axis;     ///< spin axis, model coordinates; default `up` where given, else the model's
  std::optional<Vec3> up;       ///< default the model's, else +z
  std::optional<Vec3> contact;  ///< a point of the axis; default the model's, else the lowest point along it
  std::optional<LengthUnit> unit;  ///< of a file whose format has none; default mm
  Mending mending;                 ///< of a file
  /// Longest side of the bounding box, mm; default the model's, else as the file is in its
  /// unit.
  std::optional<double> size;
  double density = 1.0;  ///< of the shell, g/cm^3, > 0
  std::optional<double>
      interior_density;       ///< of what is left of the interior, g/cm^3, > 0; default `density`
  double void_density = 0.0;  ///< of what fills the voids, g/cm^3; >= 0, another than the interior's
  int fineness = 0;           ///< of a parametric model; 0: the model's own default
  /// The body frame's z is `up`, not the spin axis, unless `axis` is given.
  bool stands_upright = false;
  /// Where no contact is given, the origin is the solid's centre of mass; and an axle may be asked for.
  bool centred = false;
  AxleSpec axle;
  StemSpec stem;                  ///< a peg along the axis, of the shell's material
  std::optional<double> flatten;  ///< what is cut off at the bottom, mm along the axis

  /// Whether axis and contact point decide what shape it is.
  [[nodiscard]] bool shaped_along_axis() const { return axle.radius || stem.wanted() || flatten; }
  bool operator==(const BodySpec&) const = default;
};

/// How a body lies where nobody says otherwise; model coordinates, mm.
struct UsualPose {
  Vec3 axis = Vec3::UnitZ(), up = Vec3::UnitZ();  ///< of unit length
  std::optional<Vec3> contact = {};               ///< nothing: the lowest point along the axis
};

/// A solid. Body units: lengths in L = V^(1/3), masses in its own mass if all of it were of the shell's
/// density.
struct Body {
  std::string name;
  TriangleMesh mesh;   ///< model coordinates, mm
  TriangleMesh local;  ///< the same in the body frame, body units
  Frame frame;
  Vec3 axis, contact;                ///< as used, model coordinates
  double density = 1.0;              ///< of the shell, g/cm^3
  double interior_density = 1.0;     ///< of the interior that is no void, g/cm^3
  double void_density = 0.0;         ///< g/cm^3
  std::vector<std::string> repairs;  ///< what was mended in the file's mesh, one line each
  UsualPose usual;
  LazyHull hull;             ///< of the mesh
  LazyCavities cavities;     ///< of the mesh
  std::optional<Axle> axle;  ///< mm; the mesh then is both halves, and the axle not in it
  /// What is fixed and not in the mesh, an axle of the same material; body frame and units.
  Moments added = Moments::Zero();
  /// Of the whole solid with what is added, body frame and units; the mesh's share of solid[S1] is 1 up to
  /// round-off.
  Moments solid;

  /// Whether shell and interior are of the same material.
  [[nodiscard]] bool one_material() const { return interior_density == density; }
  /// Whether the voids' filling is what weighs more.
  [[nodiscard]] bool heavy_voids() const { return void_density > interior_density; }

  [[nodiscard]] double mass_grams() const {
    return density * frame.length * frame.length * frame.length * 1e-3;
  }
};

/// Reads or makes the model, mends a file's mesh where that is safe (repair.hpp), checks it, lays its frame
/// and integrates its moments on the device.
///
/// @throws InputError  unknown model, unreadable or unfit mesh, zero axis, size or density <= 0, voids as
/// dense
///                     as the interior, a contact point whose axis misses the body
[[nodiscard]] Body make_body(const BodySpec& spec, device::Device& device);

/// Mean of the vertices that are lowest along the axis: a flat base gives its middle, a tip gives itself.
/// The default contact point. @param axis  any length but zero, coordinates of the mesh
[[nodiscard]] Vec3 lowest_point(const TriangleMesh& mesh, const Vec3& axis);

/// Lays `body`, a copy of `made`, into another frame: z along `axis` (any length but zero), origin at
/// `contact`, both in model coordinates. As often as wanted: round-off does not add up.
void reframe(Body& body, const Body& made, const Vec3& axis, const Vec3& contact);

/// The same solid as another specification of the same mesh, size and axle wants it: axis, contact and
/// densities; what make_body() would make anew, up to round-off.
/// @throws InputError  as make_body()
[[nodiscard]] Body reposed(Body made, const BodySpec& spec);

using kreisel::MassModel;

/// @param interior  moments of the whole domain at unit density: what can be hollowed
[[nodiscard]] MassModel hollowed(const Body& body, const Moments& interior);

}  // namespace kreisel::core
