#include "nest/decide/sphere_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/triangle.hpp"

namespace kreisel::core::nest {
namespace {

// A centre of coordinates up to 4 is rounded by 2^-22 when it is stored and by a few times that when it is
// turned.
constexpr double room = 0x1p-19;

struct Part {
  std::uint32_t node, first, last;
};

/// What a triangle adds to the nodes above it.
struct Piece {
  Vec3 middle, area;
};

class Builder {
 public:
  explicit Builder(const TriangleMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    for (const Triangle& t : mesh.triangles) pieces_.push_back({middle_of(mesh, t), normal_of(mesh, t)});
  }

  std::vector<SphereTree::Node> nodes() {
    std::vector<SphereTree::Node> nodes(1);
    nodes.reserve(2 * order_.size());
    std::vector<Part> parts{{0, 0, std::uint32_t(order_.size())}};
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      SphereTree::Node node = around(part);
      if (part.last - part.first == 1) {
        node.leaf = 1;
        node.first = order_[part.first];
      } else {
        const std::uint32_t split = divide(part);
        node.first = std::uint32_t(nodes.size());
        nodes.resize(nodes.size() + 2);
        parts.push_back({node.first, part.first, split});
        parts.push_back({node.first + 1, split, part.last});
      }
      nodes[part.node] = node;
    }
    return nodes;
  }

 private:
  template <class Visit>
  void each_corner(const Part& part, Visit&& visit) const {
    for (std::uint32_t i = part.first; i < part.last; ++i)
      for (const std::uint32_t v : mesh_->triangles[order_[i]]) visit(mesh_->vertices[v]);
  }

  [[nodiscard]] SphereTree::Node around(const Part& part) const {
    Box box;
    Vec3 area = Vec3::Zero();
    each_corner(part, [&](const Vec3& v) { box.add(v); });
    for (std::uint32_t i = part.first; i < part.last; ++i) area += pieces_[order_[i]].area;
    const Vec3 centre = box.centre(),
               normal = area.norm() > 0 ? Vec3(area.normalized()) : Vec3(Vec3::UnitZ());
    double radius = 0, least = INFINITY, most = -INFINITY;
    each_corner(part, [&](const Vec3& v) {
      const double height = normal.dot(v - centre);
      radius = std::max(radius, (v - centre).squaredNorm());
      least = std::min(least, height), most = std::max(most, height);
    });
    SphereTree::Node node;
    node.centre = centre.cast<float>();
    node.radius = float(std::sqrt(radius) + room);
    node.normal = normal.cast<float>();
    node.least = float(least - room);
    node.most = float(most + room);
    return node;
  }

  /// In two halves across the longest side of the box of the middles.
  std::uint32_t divide(const Part& part) {
    Box box;
    for (std::uint32_t i = part.first; i < part.last; ++i) box.add(pieces_[order_[i]].middle);
    int axis = 0;
    box.extent().maxCoeff(&axis);
    const std::uint32_t split = part.first + (part.last - part.first) / 2;
    std::nth_element(order_.begin() + part.first, order_.begin() + split, order_.begin() + part.last,
                     [&](std::uint32_t i, std::uint32_t j) {
                       const double x = pieces_[i].middle[axis], y = pieces_[j].middle[axis];
                       return x != y ? x < y : i < j;
                     });
    return split;
  }

  const TriangleMesh* mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Piece> pieces_;
};

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh) : nodes_(Builder(mesh).nodes()) {}

}  // namespace kreisel::core::nest
