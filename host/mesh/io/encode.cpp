#include "mesh/io/encode.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>
#include <limits>

#include "error.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written little-endian");

/// joined(), and every coordinate a number.
TriangleMesh finite(const std::vector<TriangleMesh>& parts, const std::string& name) {
  TriangleMesh mesh = joined(parts, name);
  require_coordinates_within(std::numeric_limits<double>::max(), "finite coordinates", mesh, name);
  return mesh;
}

template <class Value>
void append(std::string& bytes, const Value* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

}  // namespace

TriangleMesh joined(const std::vector<TriangleMesh>& parts, const std::string& name) {
  TriangleMesh mesh;
  std::size_t vertices = 0, triangles = 0;
  for (const TriangleMesh& part : parts) {
    vertices += part.vertices.size();
    triangles += part.triangles.size();
  }
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (vertices > most || triangles > most)
    throw InputError(fmt::format("{}: {} vertices and {} triangles, expected fewer than 2^32 of each", name,
                                 vertices, triangles));
  mesh.vertices.reserve(vertices);
  mesh.triangles.reserve(triangles);
  for (const TriangleMesh& part : parts) {
    const auto offset = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles)
      mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return mesh;
}

void require_coordinates_within(double limit, std::string_view expected, const TriangleMesh& mesh,
                                const std::string& name) {
  for (const Vec3& v : mesh.vertices)
    if (!((v.array().abs() <= limit).all()))  // not so for NaN either
      throw InputError(
          fmt::format("{}: vertex ({}, {}, {}), expected {}", name, v.x(), v.y(), v.z(), expected));
}

std::string encode_obj(const std::vector<TriangleMesh>& parts, const std::string& name) {
  const TriangleMesh mesh = finite(parts, name);
  std::string text = "# kreisel, units mm\n";
  const auto out = std::back_inserter(text);
  for (const Vec3& v : mesh.vertices) {
    stop_here();
    fmt::format_to(out, "v {} {} {}\n", v.x(), v.y(), v.z());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    stop_here();
    fmt::format_to(out, "f {} {} {}\n", std::uint64_t{a} + 1, std::uint64_t{b} + 1, std::uint64_t{c} + 1);
  }
  return text;
}

std::string encode_off(const std::vector<TriangleMesh>& parts, const std::string& name) {
  const TriangleMesh mesh = finite(parts, name);
  std::string text =
      fmt::format("OFF\n# kreisel, units mm\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  const auto out = std::back_inserter(text);
  for (const Vec3& v : mesh.vertices) {
    stop_here();
    fmt::format_to(out, "{} {} {}\n", v.x(), v.y(), v.z());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    stop_here();
    fmt::format_to(out, "3 {} {} {}\n", a, b, c);
  }
  return text;
}

std::string encode_ply(const std::vector<TriangleMesh>& parts, const std::string& name) {
  const TriangleMesh mesh = finite(parts, name);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment kreisel, units mm\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) append(bytes, v.data(), 3);
  for (const Triangle& t : mesh.triangles) {
    bytes += '\3';
    append(bytes, t.data(), 3);
  }
  return bytes;
}

}  // namespace kreisel::core
