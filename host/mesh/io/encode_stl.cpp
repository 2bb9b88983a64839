#include <fmt/format.h>

#include <Eigen/Geometry>
#include <bit>
#include <limits>

#include "error.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");
constexpr std::size_t stl_header_bytes = 80;
constexpr char header_text[] = "kreisel binary STL, units mm";  // must not begin with "solid"

void append(std::string& bytes, const Vec3& v) {
  const Eigen::Vector3f narrow = v.cast<float>();
  bytes.append(reinterpret_cast<const char*>(narrow.data()), sizeof(float) * 3);
}

}  // namespace

std::string encode_stl(const std::vector<TriangleMesh>& parts, const std::string& name) {
  TriangleMesh mesh = joined(parts, name);
  require_coordinates_within(double(std::numeric_limits<float>::max()), "coordinates within float", mesh,
                             name);
  for (Vec3& v : mesh.vertices) v = in_single_precision(v);  // normals are those of what is written
  std::string bytes = header_text;
  bytes.resize(stl_header_bytes);
  const auto count = std::uint32_t(mesh.triangles.size());
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& [a, b, c] : mesh.triangles) {
    stop_here();
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    append(bytes, (q - p).cross(r - p).stableNormalized());
    for (const Vec3& corner : {p, q, r}) append(bytes, corner);
    bytes.append(2, '\0');  // attribute byte count, always zero
  }
  return bytes;
}

}  // namespace kreisel::core
