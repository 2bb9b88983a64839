#include "domain/octree.hpp"

#include <algorithm>
#include <bit>

namespace kreisel::core {
namespace {

/// The bits of a number, two zeros between each and the next.
std::uint32_t spread(std::uint32_t v) {
  v = (v | v << 16) & 0x030000ffu;
  v = (v | v << 8) & 0x0300f00fu;
  v = (v | v << 4) & 0x030c30c3u;
  return (v | v << 2) & 0x09249249u;
}

/// The octree above a list of leaves, walked through all faces inside it.
class Faces {
 public:
  Faces(std::span<const Cube> cubes, int levels) : cubes_(cubes), size_(std::uint32_t{1} << 3 * levels) {
    for (const Cube& cube : cubes) place_.push_back(place_on_curve(cube));
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> walk() {
    if (!cubes_.empty()) inside({0, static_cast<std::uint32_t>(cubes_.size()), 0, size_});
    return std::move(pairs_);
  }

 private:
  /// The leaves [begin, end) that lie within `size` places of the curve from `place` on.
  struct Node {
    std::uint32_t begin, end, place, size;
  };

  [[nodiscard]] static bool empty(const Node& node) { return node.begin == node.end; }
  [[nodiscard]] bool leaf(const Node& node) const {
    const std::uint32_t edge = cubes_[node.begin].edge;
    return node.end - node.begin == 1 && edge * edge * edge == node.size;
  }
  [[nodiscard]] std::array<Node, 8> parts(const Node& node) const {
    std::array<Node, 8> all;
    const std::uint32_t size = node.size / 8;
    std::uint32_t begin = node.begin;
    for (std::uint32_t part = 0; part < 8; ++part) {
      const std::uint32_t place = node.place + part * size;
      // The last part ends where the node does; others are short, or the search is.
      const auto from = place_.begin() + begin, to = place_.begin() + node.end;
      const std::uint32_t end =
          part == 7 ? node.end
                    : static_cast<std::uint32_t>(std::lower_bound(from, to, place + size) - place_.begin());
      all[part] = {begin, end, place, size};
      begin = end;
    }
    return all;
  }

  void inside(const Node& node) {
    if (empty(node) || leaf(node)) return;
    const std::array<Node, 8> part = parts(node);
    for (const Node& p : part) inside(p);
    for (int axis = 0; axis < 3; ++axis)
      for (int p = 0; p < 8; ++p)
        if ((p >> axis & 1) == 0) across(part[p], part[p | 1 << axis], axis);
  }

  /// The faces between two neighbouring nodes, `low` on the lower side.
  void across(const Node& low, const Node& high, int axis) {
    if (empty(low) || empty(high)) return;
    const bool low_is_leaf = leaf(low), high_is_leaf = leaf(high);
    if (low_is_leaf && high_is_leaf) {
      pairs_.emplace_back(low.begin, high.begin);
      return;
    }
    std::array<Node, 8> below, above;
    if (!low_is_leaf) below = parts(low);
    if (!high_is_leaf) above = parts(high);
    for (int p = 0; p < 8; ++p)
      if ((p >> axis & 1) == 0)
        across(low_is_leaf ? low : below[p | 1 << axis], high_is_leaf ? high : above[p], axis);
  }

  std::span<const Cube> cubes_;
  std::uint32_t size_;
  std::vector<std::uint32_t> place_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

}  // namespace

Cube Cube::child(int part) const {
  const auto half = static_cast<std::uint16_t>(edge / 2);
  const auto at = [&](std::uint16_t corner, int axis) {
    return static_cast<std::uint16_t>(corner + (part >> axis & 1) * half);
  };
  return {at(x, 0), at(y, 1), at(z, 2), half};
}

Cube Cube::parent() const {
  const auto twice = static_cast<std::uint16_t>(2 * edge);
  const auto at = [&](std::uint16_t corner) { return static_cast<std::uint16_t>(corner & ~(twice - 1)); };
  return {at(x), at(y), at(z), twice};
}

std::uint32_t place_on_curve(const Cube& cube) {
  return spread(cube.x) | spread(cube.y) << 1 | spread(cube.z) << 2;
}

int octree_levels(const Grid& grid) {
  return std::bit_width(static_cast<unsigned>(*std::ranges::max_element(grid.n)) - 1);
}

namespace {

/// The cubes of an edge within `cube` that meet the grid, along the curve.
void add_uniform(const Grid& grid, int edge, const Cube& cube, std::vector<Cube>& cubes) {
  if (cube.x >= grid.n[0] || cube.y >= grid.n[1] || cube.z >= grid.n[2]) return;
  if (cube.edge == edge)
    cubes.push_back(cube);
  else
    for (int part = 0; part < 8; ++part) add_uniform(grid, edge, cube.child(part), cubes);
}

}  // namespace

std::vector<Cube> uniform_cubes(const Grid& grid, int edge) {
  std::vector<Cube> cubes;
  const int whole = std::max(edge, 1 << octree_levels(grid));
  add_uniform(grid, edge, {0, 0, 0, static_cast<std::uint16_t>(whole)}, cubes);
  return cubes;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> shared_faces(std::span<const Cube> cubes, int levels) {
  return Faces(cubes, levels).walk();
}

}  // namespace kreisel::core
