// cgal_check.cpp - what CGAL says of a mesh: is it closed, does it run through itself, does it bound a
// volume?
//
//   cgal_check FILE...   one line each: file triangles N closed B self_intersects B bounds_volume B volume V
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// A binary STL, read without the project's own code; equal corners become one vertex.
/// @return  false where the triangles do not make a surface
bool read_stl(const std::string& path, Mesh& mesh) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::uint32_t count = 0;
  if (bytes.size() < 84) return false;
  std::memcpy(&count, bytes.data() + 80, 4);
  if (bytes.size() != 84 + std::size_t(count) * 50) return false;
  std::map<std::array<float, 3>, Mesh::Vertex_index> vertices;
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<Mesh::Vertex_index, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<float, 3> at;
      std::memcpy(at.data(), bytes.data() + 84 + std::size_t(t) * 50 + 12 + 12 * i, 12);
      const auto [entry, fresh] = vertices.try_emplace(at);
      if (fresh) entry->second = mesh.add_vertex({at[0], at[1], at[2]});
      corners[i] = entry->second;
    }
    if (mesh.add_face(corners[0], corners[1], corners[2]) == Mesh::null_face()) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    Mesh mesh;
    if (!read_stl(argv[i], mesh)) {
      std::printf("%s no surface\n", argv[i]);
      continue;
    }
    const bool closed = CGAL::is_closed(mesh), crosses = pmp::does_self_intersect(mesh);
    std::printf("%s triangles %zu closed %d self_intersects %d bounds_volume %d volume %.9g\n", argv[i],
                std::size_t(mesh.number_of_faces()), closed, crosses,
                closed && !crosses && pmp::does_bound_a_volume(mesh), CGAL::to_double(pmp::volume(mesh)));
  }
  return 0;
}
