#include "body/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/mesh_moments.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/make/cut_plane.hpp"

namespace kreisel::core {
namespace {

/// A contact point far beside the body is a typing error: nothing there can be spun or stood on.
void require_near_axis(const Body& body) {
  const Eigen::Matrix3d turn = axis_to_z(body.axis);
  const Box box = bounding_box(moved(body.mesh, turn));
  const Vec3 at = turn * body.contact, size = bounding_box(body.mesh).extent();
  for (int a = 0; a < 2; ++a)
    if (at[a] < box.lo[a] || at[a] > box.hi[a])
      throw InputError(
          fmt::format("contact {} lies off the axis: a line along {} through it misses the body, {:.4g} mm; "
                      "expected a point of the axis, model coordinates in mm",
                      fmt::join(body.contact, ","), fmt::join(body.axis, ","), fmt::join(size, " x ")));
}

Vec3 direction(const Vec3& v, const char* option) {
  if (!v.allFinite() || v.norm() == 0)
    throw InputError(
        fmt::format("{} {} has no direction; expected a non-zero vector", option, fmt::join(v, ",")));
  return v.normalized();
}

void require_valid(const BodySpec& spec) {
  if (!(spec.density > 0) || !std::isfinite(spec.density))
    throw InputError(fmt::format("density {} g/cm^3; expected > 0", spec.density));
  const double interior = spec.interior_density.value_or(spec.density);
  if (!(interior > 0) || !std::isfinite(interior))
    throw InputError(fmt::format("interior density {} g/cm^3; expected > 0", interior));
  if (!(spec.void_density >= 0) || !std::isfinite(spec.void_density))
    throw InputError(fmt::format("void density {} g/cm^3; expected 0 or more", spec.void_density));
  if (spec.void_density == interior)
    throw InputError(fmt::format(
        "void density {} g/cm^3 in an interior of {}; expected another than it: there is nothing to design",
        spec.void_density, interior));
  (void)axle_of(spec.axle);
  if (stem_of(spec.stem) && (spec.stands_upright || spec.centred))
    throw InputError(
        "--stem or --tip for a problem that does not spin on a point; expected --problem spin or top");
  if (spec.flatten && (!(*spec.flatten > 0) || !std::isfinite(*spec.flatten)))
    throw InputError(fmt::format("--flatten {} mm; expected > 0", *spec.flatten));
  if (spec.axle.radius && !spec.centred)
    throw InputError(fmt::format("--axle {} mm for a problem without an axle; expected --problem yoyo",
                                 *spec.axle.radius));
  if (spec.size && (!(*spec.size > 0) || !std::isfinite(*spec.size)))
    throw InputError(fmt::format("size {} mm; expected > 0", *spec.size));
}

void set_densities(Body& body, const BodySpec& spec) {
  body.density = spec.density;
  body.interior_density = spec.interior_density.value_or(spec.density);
  body.void_density = spec.void_density;
}

/// Axis and contact point, but for a body whose contact is its centre of mass.
void pose(Body& body, const BodySpec& spec) {
  const Vec3 up = spec.up ? direction(*spec.up, "--up") : body.usual.up;
  body.axis = spec.axis                        ? direction(*spec.axis, "--axis")
              : spec.up || spec.stands_upright ? up
                                               : body.usual.axis;
  // A contact point given by hand is in the coordinates of the file as it is written out, after --size.
  body.contact = spec.contact         ? *spec.contact
                 : body.usual.contact ? *body.usual.contact
                                      : lowest_point(body.mesh, body.axis);
  if (!body.contact.allFinite()) throw InputError("--contact is not finite; expected three numbers, mm");
  if (spec.contact) require_near_axis(body);
}

/// Another frame of the same length. @param mesh  the body's, model coordinates
void lay(Body& body, const TriangleMesh& mesh, const Vec3& axis, const Vec3& contact) {
  body.axis = axis.normalized();
  body.contact = contact;
  body.frame = {axis_to_z(body.axis), contact, body.frame.length};
  for (std::size_t i = 0; i < body.local.vertices.size(); ++i)
    body.local.vertices[i] = body.frame.to_body(mesh.vertices[i]);
}

/// Moments in one frame as they are in another of the same length.
Moments moved_into(const Frame& to, const Moments& s, const Frame& from) {
  return transformed(s, to.rotation * from.rotation.transpose(), to.to_body(from.origin));
}

/// The mesh without what is lower than `depth` above its lowest point. @throws InputError  that is all of it
TriangleMesh flattened(const TriangleMesh& mesh, const Vec3& up, double depth) {
  const Eigen::Matrix3d turn = axis_to_z(up);
  const TriangleMesh upright = moved(mesh, turn);
  const Box box = bounding_box(upright);
  if (depth >= box.extent()[2])
    throw InputError(fmt::format("--flatten {:.4g} mm of a body that is {:.4g} mm high; expected less", depth,
                                 box.extent()[2]));
  return moved(above_plane(upright, box.lo[2] + depth), Eigen::Matrix3d(turn.transpose()));
}

/// Joins the peg; from then on the body stands on its point.
void add_stem(Body& body, const Stem& stem) {
  const Frame millimetres{axis_to_z(body.axis), body.contact, 1};
  Stemmed joined = with_stem(to_body(millimetres, body.mesh), stem);
  body.mesh = to_model(millimetres, std::move(joined.mesh));
  body.contact = millimetres.to_model({0, 0, joined.point});
}

}  // namespace

Body reposed(Body body, const BodySpec& spec) {
  require_valid(spec);
  const Vec3 axis = body.axis, contact = body.contact;
  const Frame frame = body.frame;
  const Moments solid = body.solid;
  set_densities(body, spec);
  pose(body, spec);
  if (spec.centred && !spec.contact) body.contact = frame.to_model(centre_of_mass(solid));
  if (body.axis != axis || body.contact != contact) {
    lay(body, body.mesh, body.axis, body.contact);
    body.solid = moved_into(body.frame, solid, frame);
  }
  return body;
}

Vec3 lowest_point(const TriangleMesh& mesh, const Vec3& axis) {
  // Far from the origin heights are taken above a point of the mesh, or they would lose their digits.
  const Vec3 from = mesh.vertices.front();
  const auto height = [&](const Vec3& v) { return (v - from).dot(axis); };
  double low = 0, high = 0;
  for (const Vec3& v : mesh.vertices) {
    low = std::min(low, height(v));
    high = std::max(high, height(v));
  }
  const double rounding =
      4 * std::numeric_limits<double>::epsilon() * from.cwiseAbs().maxCoeff() * axis.norm();
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const Vec3& v : mesh.vertices)
    if (height(v) <= low + std::max(1e-9 * (high - low), rounding)) {
      sum += v - from;
      ++count;
    }
  return from + sum / count;
}

Body make_body(const BodySpec& spec, device::Device& device) {
  require_valid(spec);  // ahead of the reading: a typing error costs no time
  return make_body(spec, load_solid(spec), device);
}

namespace {

/// @param moments_of  a mesh at unit density
template <class MomentsOf>
Body laid(const BodySpec& spec, Source source, const MomentsOf& moments_of) {
  require_valid(spec);
  Body body;
  body.name = source.name;
  body.repairs = std::move(source.repairs);
  set_densities(body, spec);
  const std::optional<double> size = spec.size ? spec.size : source.size;
  const double scale = size ? *size / bounding_box(source.mesh).extent().maxCoeff() : source.millimetres;
  for (Vec3& v : source.mesh.vertices) v *= scale;
  body.mesh = std::move(source.mesh);

  body.usual = {source.axis.normalized(), source.up.normalized(), {}};
  if (source.contact) body.usual.contact = scale * *source.contact;
  pose(body, spec);
  if (spec.flatten) {
    body.mesh = flattened(body.mesh, body.axis, *spec.flatten);
    if (!spec.contact) body.contact = lowest_point(body.mesh, body.axis);
  }
  if (const auto stem = stem_of(spec.stem)) add_stem(body, *stem);
  // About a point of the body: about an origin far away the digits of a moment are those of the distance.
  const auto volume_and_centre = [&] {
    const Vec3 middle = bounding_box(body.mesh).centre();
    const Moments s = moments_of(moved(body.mesh, Eigen::Translation3d(-middle)));
    return std::pair(s[S1], Vec3(centre_of_mass(s) + middle));
  };
  auto [volume, centre] = volume_and_centre();
  if (spec.centred && !spec.contact) body.contact = centre;
  body.axle = axle_of(spec.axle);
  if (body.axle) {
    const Frame millimetres{axis_to_z(body.axis), body.contact, 1};
    body.mesh = to_model(millimetres, halves(to_body(millimetres, body.mesh), *body.axle));
    volume = volume_and_centre().first;
  }
  body.frame = {axis_to_z(body.axis), body.contact, std::cbrt(volume)};
  body.local = to_body(body.frame, body.mesh);
  body.solid = moments_of(body.local);
  if (body.axle) {
    const double length = body.frame.length;
    const Axle axle = {body.axle->radius / length, body.axle->slot / length, body.axle->depth / length};
    body.added = reference::mesh_moments(axle_mesh(axle)).value;
    body.solid += body.added;
  }
  return body;
}

}  // namespace

Body make_body(const BodySpec& spec, Source source, device::Device& device) {
  return laid(spec, std::move(source), [&](const TriangleMesh& mesh) { return mesh_moments(mesh, device); });
}

Body make_body(const BodySpec& spec, Source source) {
  return laid(spec, std::move(source),
              [](const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value; });
}

void reframe(Body& body, const Body& made, const Vec3& axis, const Vec3& contact) {
  lay(body, made.mesh, axis, contact);
  body.solid = moved_into(body.frame, made.solid, made.frame);
}

MassModel hollowed(const Body& body, const Moments& interior) {
  const auto [light, heavy] = std::minmax(body.interior_density, body.void_density);
  return {body.solid + (light / body.density - 1) * interior, (heavy - light) / body.density, interior};
}

}  // namespace kreisel::core
