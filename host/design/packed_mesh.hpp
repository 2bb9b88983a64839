// packed_mesh.hpp - a mesh in few bytes, for pages.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A mesh as bytes that compress well, about 2 a triangle then. Places are rounded to `step`; which triangle
/// has which corners is kept. page.html unpacks it, and says how in fewer words.
///
/// Corners are numbered as they are met, and triangles come in fans: for each corner in the order of the
/// numbers, those that no corner before it had. Triangles (v, a, b), (v, b, c), ... of a fan that share edges
/// are a chain.
/// - `links`: for each corner its chains, then 0. A chain is how many triangles it has (at most 255), then
/// the corners
///   a, b, c, ...: 0 a new one; 1 to 100 so much below the next new number; 101 to 200 that less 100 above v;
///   255 the same as a number of 7 bits a byte, lowest first.
/// - `places`: x y z of each corner less what is guessed from the chain (the parallelogram), modulo 2^16,
/// sign in the lowest
///   bit: all low bytes, then all high ones.
struct PackedMesh {
  std::size_t corners = 0, triangles = 0;
  Vec3 low = Vec3::Zero();  ///< of the box
  double step = 0;          ///< a 2^14th of its longest edge
  std::vector<std::uint8_t> links, places;
};

/// Triangles that have a corner twice, and corners without a triangle, are left out.
[[nodiscard]] PackedMesh packed(const TriangleMesh& mesh);

/// What packed() kept: its corners in the order of their numbers. page.html does the same.
[[nodiscard]] TriangleMesh unpacked(const PackedMesh& mesh);

/// As a page holds it: compressed (gzip, RFC 1952), then in base64.
[[nodiscard]] std::string compressed_text(const void* bytes, std::size_t size);

}  // namespace kreisel::core
