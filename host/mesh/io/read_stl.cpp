// Not OpenMesh's STL reader: it narrows text coordinates to float, has its merge tolerance as shared state of
// the process, and takes what a cut-off file still holds without a word.
#include "mesh/io/read_stl.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <unordered_map>

namespace kreisel::core {
namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, facet_bytes = 50;
static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

/// Gathers corners; equal coordinates share an index. 0 and -0 are equal.
class CornerMerge {
 public:
  explicit CornerMerge(TriangleMesh& mesh) : mesh_(mesh) {}

  std::uint32_t operator()(const Vec3& p) {
    const Key key{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0 + 0 is 0
    const auto [entry, fresh] = index_.try_emplace(key, std::uint32_t(mesh_.vertices.size()));
    if (fresh) mesh_.vertices.emplace_back(key[0], key[1], key[2]);
    return entry->second;
  }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (const double x : key) {  // multiply and fold: neighbouring floats differ in high bits only
        h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
        h ^= h >> 32;
      }
      return h;
    }
  };
  TriangleMesh& mesh_;
  std::unordered_map<Key, std::uint32_t, Hash> index_;
};

/// Bytes the file has if it is binary and whole, by its facet count; at least header and count.
std::uint64_t binary_length(std::string_view bytes) {
  if (bytes.size() < header_bytes + count_bytes) return header_bytes + count_bytes;
  std::uint32_t facets = 0;
  std::memcpy(&facets, bytes.data() + header_bytes, count_bytes);
  return header_bytes + count_bytes + std::uint64_t{facets} * facet_bytes;
}

/// Many binary files begin with "solid" too, so that word alone decides nothing. Text has no zero bytes; a
/// binary file has them in its facet count.
bool is_text(std::string_view bytes) {
  if (bytes.size() >= header_bytes + count_bytes && bytes.size() == binary_length(bytes)) return false;
  const std::size_t start = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  return bytes.substr(start).starts_with("solid") && bytes.find('\0') == std::string_view::npos;
}

TriangleMesh read_binary(const MeshFile& file) {
  const std::uint64_t want = binary_length(file.bytes);
  if (file.bytes.size() != want)
    throw InputError(fmt::format("{}: binary STL of {} bytes, expected {} by its facet count", file.name,
                                 file.bytes.size(), want));
  TriangleMesh mesh;
  CornerMerge corner(mesh);
  const std::size_t facets = (file.bytes.size() - header_bytes - count_bytes) / facet_bytes;
  for (std::size_t f = 0; f < facets; ++f) {
    float v[12];  // normal, then three corners
    std::memcpy(v, file.bytes.data() + header_bytes + count_bytes + f * facet_bytes, sizeof v);
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p(v[3 * k + 3], v[3 * k + 4], v[3 * k + 5]);
      if (!p.allFinite())
        throw InputError(fmt::format("{}: vertex {} of facet {} is ({}, {}, {}), expected finite coordinates",
                                     file.name, k + 1, f + 1, p.x(), p.y(), p.z()));
      t[k] = corner(p);
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

TriangleMesh read_text(const MeshFile& file) {
  TriangleMesh mesh;
  CornerMerge corner(mesh);
  MeshLines lines(file);
  std::vector<std::uint32_t> loop;
  std::size_t seen = 0;
  bool open = false;  // between solid and endsolid
  for (std::string_view line; lines.next(line);) {
    const std::string_view word = next_word(line);
    if (word == "solid") {
      open = true;
    } else if (word == "vertex") {
      loop.push_back(corner(lines.point(line, ++seen)));
    } else if (word == "endloop") {
      if (loop.size() != 3) throw lines.error(fmt::format("facet of {} vertices, expected 3", loop.size()));
      add_fan(mesh, loop);
      loop.clear();
    } else if (word == "endsolid") {
      open = false;
    } else if (word != "facet" && word != "outer" && word != "endfacet") {
      throw lines.error(fmt::format("'{}', expected a word of text STL", shown(word)));
    }
  }
  if (open || !loop.empty()) throw lines.error("text STL ends without 'endsolid', expected a whole file");
  return mesh;
}

}  // namespace

TriangleMesh read_stl(const MeshFile& file) {
  return is_text(file.bytes) ? read_text(file) : read_binary(file);
}

}  // namespace kreisel::core
