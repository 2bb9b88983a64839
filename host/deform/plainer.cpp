#include "deform/plainer.hpp"

#include "body/mesh_moments.hpp"
#include "mesh/solid/simplify.hpp"

namespace kreisel::core {

std::optional<Body> plainer(const Body& body) {
  constexpr std::size_t many = 12000;
  if (body.local.triangles.size() <= many) return std::nullopt;
  const double off = 1e-3 * bounding_box(body.local).extent().maxCoeff();
  Body plain = body;
  plain.local = simplified(body.local, {off, off});
  plain.solid = reference::mesh_moments(plain.local).value + body.added;
  return plain;
}

}  // namespace kreisel::core
