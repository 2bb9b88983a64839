#include "mesh/query/equal_vertices.hpp"

#include <algorithm>
#include <numeric>

namespace kreisel::core {

std::vector<std::uint32_t> first_equal_vertex(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::tie(vertices[i].x(), vertices[i].y(), vertices[i].z());
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return vertices[i] == vertices[j] ? i < j : key(i) < key(j);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k && vertices[order[k]] == vertices[order[k - 1]] ? first[order[k - 1]] : order[k];
  return first;
}

}  // namespace kreisel::core
