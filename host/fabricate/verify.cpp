#include "fabricate/verify.hpp"

#include <fmt/format.h>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "mesh/check.hpp"
#include "mesh/read.hpp"
#include "mesh/separate_edges.hpp"

namespace kreisel {

WrittenPart verify_file(const std::filesystem::path& file, const Body& body, const Problem& problem) {
  WrittenPart part;
  try {
    TriangleMesh mesh = read_mesh(file);
    part.triangles = mesh.triangles.size();
    // STL has no vertices of its own: where parts of the body touch along an edge, theirs became one.
    (void)separate_edges(mesh);
    require_solid(mesh, file.filename().string());
    const Moments material = reference::mesh_moments(to_body(body.frame, mesh)).value + body.added;
    part.moments = material + body.void_share() * (body.solid - material);  // what is void holds the filling
  } catch (const InputError& error) {
    part.verdict.text = fmt::format("the written mesh is not a solid: {}", error.what());
    return part;
  }
  part.verdict = problem.verify(part.moments, body.frame.length);
  return part;
}

}  // namespace kreisel
