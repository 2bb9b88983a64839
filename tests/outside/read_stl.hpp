// read_stl.hpp - a binary STL file, read without the project's own code.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Equal corners become one vertex.
/// @return  false where the triangles do not make a surface
inline bool read_stl(const std::string& path, Mesh& mesh) {
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
