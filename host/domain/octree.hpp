// octree.hpp - a grid's cells in cubes, from coarse to fine, and which cubes share a face.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "domain/grid.hpp"

namespace kreisel::core {

/// A cube of a grid's cells: one node of an octree. Its edge is a power of two and its corner a multiple of
/// the edge, so cubes are disjoint or one holds the other.
struct Cube {
  static constexpr int most_edge = 256;  ///< cell_moments.cl sums a row of it in 32 bits

  std::uint16_t x, y, z;  ///< corner, in cells of the grid
  std::uint16_t edge;     ///< in cells; 1 at the finest level

  /// One of the eight halves: bit 0 of `part` is its place along x, bit 1 along y, bit 2 along z.
  [[nodiscard]] Cube child(int part) const;
  [[nodiscard]] Cube parent() const;
  [[nodiscard]] bool operator==(const Cube&) const = default;
};

/// Where a cube's corner lies on the curve that visits the eight parts of every cube one after the other
/// [Morton 1966]: a cube's cells lie together, and a list in this order is an octree without its inner nodes.
[[nodiscard]] std::uint32_t place_on_curve(const Cube& cube);

/// Of an octree over the grid: its level 0 is one cube with an edge of 2^levels cells, the least that holds
/// the grid.
[[nodiscard]] int octree_levels(const Grid& grid);

/// All cubes of one edge that meet the grid, along the curve. @param edge  a power of two <= Cube::most_edge
[[nodiscard]] std::vector<Cube> uniform_cubes(const Grid& grid, int edge);

/// Every pair of cubes that share a face, or a part of the larger one's, once: the one on the lower side
/// first.
///
/// @param cubes   disjoint, along the curve; there may be gaps between them
/// @param levels  of the octree they are leaves of
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> shared_faces(std::span<const Cube> cubes,
                                                                                int levels);

}  // namespace kreisel::core
