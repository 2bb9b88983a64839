#include "deform/shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/mesh_moments.hpp"
#include "body/mesh_moments_gradient.hpp"
#include "body/quadric_value.hpp"
#include "error.hpp"

namespace kreisel::core {

ShapeRays shape_rays(const Body& body, const GridSpec& spec, const Wall& wall, double room) {
  Grid grid = make_grid(bounding_box(body.local), spec);
  const double thick = in_body_units(wall, body, grid);
  const int more = static_cast<int>(std::ceil(room * bounding_box(body.local).extent().maxCoeff() / grid.h));
  for (int a = 0; a < 3; ++a) {
    grid.n[static_cast<std::size_t>(a)] += 2 * more;
    grid.origin[a] -= more * grid.h;
  }
  return {grid, thick};
}

namespace {

/// The undeformed body with another skin.
Body reshaped(const Body& from, TriangleMesh local) {
  Body body;
  body.name = from.name;
  body.local = std::move(local);
  body.frame = from.frame;
  body.axis = from.axis;
  body.contact = from.contact;
  body.density = from.density;
  body.interior_density = from.interior_density;
  body.void_density = from.void_density;
  body.usual = from.usual;
  body.axle = from.axle;
  body.added = from.added;
  body.solid = reference::mesh_moments(body.local).value + from.added;
  return body;
}

ExactColumns interior_of(const TriangleMesh& mesh, const ShapeRays& rays) {
  ExactColumns domain;
  domain.grid = rays.grid;
  domain.wall = rays.wall;
  domain.intervals = SolidLines(mesh, rays.grid).intervals(rays.wall);
  if (domain.intervals.empty())
    throw InputError(
        "--deform: the wall leaves no interior to go by; expected a thinner wall or a finer grid");
  const Grid& grid = domain.grid;
  for (const ExactInterval& run : domain.intervals)
    domain.interior += box_moments({grid.centre(0, run.ix), grid.centre(1, run.iy), (run.z0 + run.z1) / 2},
                                   {grid.h, grid.h, run.z1 - run.z0});
  return domain;
}

}  // namespace

Shape::Shape(const Body& undeformed, TriangleMesh local, const ShapeRays& rays, device::Device& device)
    : body_(reshaped(undeformed, std::move(local))),
      rays_(rays),
      domain_(interior_of(body_.local, rays)),
      mass_(hollowed(body_, domain_.interior)),
      device_(device),
      quadric_(make_quadric(rays_of(domain_), device)) {}

double Shape::least(const Moments& q) const {
  return mass_.fixed.dot(q) + mass_.contrast * quadric_->oracle()->support(0, q, false).value;
}

std::vector<Vec3> Shape::gradient_of_least(const Moments& q, const std::vector<InnerPiece>& inner) const {
  std::vector<Vec3> gradient = mesh_moments_gradient(body_.local, q, device_);
  const double light = std::min(body_.interior_density, body_.void_density) / body_.density;
  for (const InnerPiece& piece : inner) {
    const double at = quadric_value(q, piece.at);
    const double weight = ((light - 1) * at + mass_.contrast * std::min(at, 0.0)) * piece.area;
    for (std::size_t k = 0; k < 3; ++k)
      gradient[piece.corners[k]] += weight * piece.barycentric[k] * piece.normal;
  }
  return gradient;
}

const std::vector<InnerPiece>& Shape::inner() const {
  // A gradient needs no finer rays than this to be right to a per cent.
  if (inner_.empty()) inner_ = inner_surface(body_.local, rays_.wall, 1.5 * rays_.grid.h);
  return inner_;
}

}  // namespace kreisel::core
