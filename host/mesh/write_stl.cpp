#include "mesh/write_stl.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <bit>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>

#include "error.hpp"

namespace kreisel {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");
constexpr std::size_t header_bytes = 80;
constexpr char header_text[] = "kreisel binary STL, units mm";  // must not begin with "solid"

void append(std::string& bytes, const Vec3& v) {
  const Eigen::Vector3f narrow = v.cast<float>();
  bytes.append(reinterpret_cast<const char*>(narrow.data()), sizeof(float) * 3);
}

std::string encode(const std::vector<TriangleMesh>& parts, const std::string& name) {
  std::size_t count = 0;
  for (const TriangleMesh& part : parts) count += part.triangles.size();
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw InputError(fmt::format("{}: {} triangles, expected fewer than 2^32 in an STL file", name, count));
  std::string bytes = header_text;
  bytes.resize(header_bytes);
  const auto count32 = std::uint32_t(count);
  bytes.append(reinterpret_cast<const char*>(&count32), sizeof count32);
  for (const TriangleMesh& part : parts) {
    for (const Vec3& v : part.vertices)
      if (!(v.cwiseAbs().maxCoeff() <= double(std::numeric_limits<float>::max())))
        throw InputError(fmt::format("{}: vertex ({}, {}, {}), expected coordinates within float", name,
                                     v.x(), v.y(), v.z()));
    for (const auto& [a, b, c] : part.triangles) {
      const Vec3 &p = part.vertices[a], &q = part.vertices[b], &r = part.vertices[c];
      append(bytes, (q - p).cross(r - p).stableNormalized());
      for (const Vec3& corner : {p, q, r}) append(bytes, corner);
      bytes.append(2, '\0');  // attribute byte count, always zero
    }
  }
  return bytes;
}

/// Removes a file unless told that it has been renamed.
struct Temporary {
  std::filesystem::path path;
  bool keep = false;
  ~Temporary() {
    std::error_code ignored;
    if (!keep) std::filesystem::remove(path, ignored);
  }
};

}  // namespace

void write_stl(const std::filesystem::path& path, const std::vector<TriangleMesh>& parts) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError(
        fmt::format("{}: no folder {}, expected one to write into", path.string(), folder.string()));
  const std::string bytes = encode(parts, path.string());

  Temporary temporary{path};
  temporary.path += fmt::format(".{}.tmp", getpid());
  std::ofstream out(temporary.path, std::ios::binary | std::ios::trunc);
  if (!out)
    throw InputError(fmt::format("{}: folder {} refuses a new file, expected write permission", path.string(),
                                 folder.string()));
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if (!out)
    throw InputError(
        fmt::format("{}: writing {} bytes failed, expected room for them", path.string(), bytes.size()));
  std::filesystem::rename(temporary.path, path, error);
  if (error) throw InputError(fmt::format("{}: {}, expected a file name", path.string(), error.message()));
  temporary.keep = true;
}

}  // namespace kreisel
