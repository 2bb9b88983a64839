#include "nest/sphere_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace kreisel::nest {
namespace {

constexpr std::uint32_t most_in_leaf = 2;

struct Part {
  std::uint32_t node, first, last;
};

Box box_of(const std::vector<Vec3>& points, const std::uint32_t* first, const std::uint32_t* last) {
  Box box{points[*first], points[*first]};
  for (const std::uint32_t* i = first; i != last; ++i) {
    box.lo = box.lo.cwiseMin(points[*i]);
    box.hi = box.hi.cwiseMax(points[*i]);
  }
  return box;
}

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh) : order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vec3> middle, lo, hi;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    lo.push_back(a.cwiseMin(b).cwiseMin(c));
    hi.push_back(a.cwiseMax(b).cwiseMax(c));
    middle.push_back(0.5 * (lo.back() + hi.back()));
  }
  nodes_.resize(1);
  std::vector<Part> parts{{0, 0, std::uint32_t(order_.size())}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    std::uint32_t *first = order_.data() + part.first, *last = order_.data() + part.last;
    const Box low = box_of(lo, first, last), high = box_of(hi, first, last);
    Node node{0.5 * (low.lo + high.hi), 0, part.first, part.last - part.first};
    for (const std::uint32_t* i = first; i != last; ++i)
      for (const std::uint32_t v : mesh.triangles[*i])
        node.radius = std::max(node.radius, (mesh.vertices[v] - node.centre).squaredNorm());
    node.radius = std::sqrt(node.radius) * (1 + 8 * std::numeric_limits<double>::epsilon());
    if (node.count > most_in_leaf) {
      const Box spread = box_of(middle, first, last);
      int axis = 0;
      spread.extent().maxCoeff(&axis);
      std::uint32_t* half = first + node.count / 2;
      std::nth_element(first, half, last, [&](std::uint32_t i, std::uint32_t j) {
        return middle[i][axis] != middle[j][axis] ? middle[i][axis] < middle[j][axis] : i < j;
      });
      node.first = std::uint32_t(nodes_.size());
      const std::uint32_t split = part.first + node.count / 2;
      node.count = 0;
      nodes_.resize(nodes_.size() + 2);
      parts.push_back({node.first, part.first, split});
      parts.push_back({node.first + 1, split, part.last});
    }
    nodes_[part.node] = node;
  }
}

}  // namespace kreisel::nest
