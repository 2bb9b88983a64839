#include "mesh/io/read_stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "geometry/exact_point_hash.hpp"
#include "geometry/first_equal.hpp"
#include "mesh/io/text.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, facet_bytes = 50;
static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

/// Gathers corners; equal coordinates share an index. 0 and -0 are equal.
class CornerMerge {
 public:
  /// @param expected  how many vertices there may be
  explicit CornerMerge(TriangleMesh& mesh, std::size_t expected = 0) : mesh_(mesh), table_(expected) {
    mesh.vertices.reserve(expected);
  }

  std::uint32_t operator()(const Vec3& p) {
    const auto next = std::uint32_t(mesh_.vertices.size());
    mesh_.vertices.push_back(p.array() + 0.0);  // -0 + 0 is 0
    const std::uint32_t first = table_(
        next, [&](std::uint32_t i) { return hash(mesh_.vertices[i]); },
        [&](std::uint32_t i, std::uint32_t j) { return mesh_.vertices[i] == mesh_.vertices[j]; });
    if (first != next) mesh_.vertices.pop_back();
    return first;
  }

  /// The indices of several corners. What their searches look at first is fetched for all of them before.
  std::span<const std::uint32_t> operator()(std::span<const Vec3> corners) {
    hashes_.clear();
    indices_.clear();
    for (const Vec3& p : corners) table_.fetch(hashes_.emplace_back(hash(p.array() + 0.0)));
    for (const std::uint64_t h : hashes_)
      if (const std::uint32_t met = table_.first_met(h); met != EqualTable::none)
        __builtin_prefetch(&mesh_.vertices[met]);
    for (const Vec3& p : corners) indices_.push_back((*this)(p));
    return indices_;
  }

 private:
  static std::uint64_t hash(const Vec3& v) { return ExactPointHash()({v.x(), v.y(), v.z()}); }

  TriangleMesh& mesh_;
  EqualTable table_;
  std::vector<std::uint64_t> hashes_;
  std::vector<std::uint32_t> indices_;
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
bool is_text(const MeshFile& file) {
  if (file.bytes.size() == binary_length(file.bytes)) return false;
  std::string_view rest = text_of(file);
  const std::string first = lower_case(next_word(rest).substr(0, 5));
  return (first == "solid" || first == "facet") && rest.find('\0') == std::string_view::npos;
}

MeshReading read_binary(const MeshFile& file) {
  const std::uint64_t size = file.bytes.size(), want = binary_length(file.bytes);
  // Some programs write a little behind the facets. What would be a facet makes the count doubtful.
  if (size < want || size >= want + facet_bytes)
    throw InputError(
        fmt::format("{}: binary STL of {} bytes, expected {} by its facet count", file.name, size, want));
  MeshReading reading;
  if (size > want)
    reading.notes.push_back(fmt::format("passed over {} bytes behind the facets", size - want));
  TriangleMesh& mesh = reading.mesh;
  const std::size_t facets = (want - header_bytes - count_bytes) / facet_bytes;
  mesh.triangles.reserve(facets);
  CornerMerge corner(mesh, facets / 2 + 2);  // as many as a ball has
  constexpr std::size_t together = 32;
  std::array<Vec3, 3 * together> corners;
  for (std::size_t from = 0; from < facets; from += together) {
    stop_here();
    const std::size_t to = std::min(from + together, facets);
    for (std::size_t f = from; f < to; ++f) {
      float v[12];  // normal, then three corners
      std::memcpy(v, file.bytes.data() + header_bytes + count_bytes + f * facet_bytes, sizeof v);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p(v[3 * k + 3], v[3 * k + 4], v[3 * k + 5]);
        if (!p.allFinite())
          throw InputError(
              fmt::format("{}: vertex {} of facet {} is ({}, {}, {}), expected finite coordinates", file.name,
                          k + 1, f + 1, p.x(), p.y(), p.z()));
        corners[3 * (f - from) + k] = p;
      }
    }
    const auto indices = corner(std::span(corners).first(3 * (to - from)));
    for (std::size_t i = 0; i < indices.size(); i += 3)
      mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  reading.weld = weld_of_binary(largest_coordinate(mesh), std::numeric_limits<float>::digits);
  return reading;
}

/// The text between "solid" and the end, whose words may stand in any lines and any case; a name goes on to
/// the end of its line, whatever it is.
class TextReader {
 public:
  explicit TextReader(const MeshFile& file) : words_(file), corner_(reading_.mesh) {}

  MeshReading read() {
    for (std::string_view word; !(word = words_.next()).empty();) statement(word);
    if (open_ || !loop_.empty())
      throw words_.error("text STL ends without 'endsolid', expected a whole file");
    reading_.weld = digits_.weld(largest_coordinate(reading_.mesh));
    return std::move(reading_);
  }

 private:
  void statement(std::string_view as_written) {
    std::string word = lower_case(as_written);
    if (word == "end") word += lower_case(words_.next());
    if (word == "solid") {
      open_ = true;
      words_.skip_line();
    } else if (word == "endsolid") {
      open_ = false;
      words_.skip_line();
    } else if (word == "facet") {
      skip_normal();
    } else if (word == "vertex") {
      loop_.push_back(corner_(words_.point(++seen_, digits_, false)));
    } else if (word == "endloop") {
      if (loop_.size() != 3)
        throw words_.error(fmt::format("facet of {} vertices, expected 3", loop_.size()));
      reading_.mesh.triangles.push_back({loop_[0], loop_[1], loop_[2]});
      loop_.clear();
    } else if (word != "outer" && word != "loop" && word != "endfacet") {
      throw words_.error(fmt::format("'{}', expected a word of text STL", shown(as_written)));
    }
  }

  /// Nothing of it is used, so nothing of it is judged; it may be left out.
  void skip_normal() {
    Words probe = words_;
    if (lower_case(probe.next()) != "normal") return;
    words_ = probe;
    for (int a = 0; a < 3; ++a) {
      probe = words_;
      if (lower_case(probe.next()) == "outer") return;
      words_ = probe;
    }
  }

  Words words_;
  MeshReading reading_;
  CornerMerge corner_;
  Digits digits_;
  std::vector<std::uint32_t> loop_;
  std::size_t seen_ = 0;
  bool open_ = false;  ///< between solid and endsolid
};

}  // namespace

MeshReading read_stl(const MeshFile& file) {
  return is_text(file) ? TextReader(file).read() : read_binary(file);
}

}  // namespace kreisel::core
