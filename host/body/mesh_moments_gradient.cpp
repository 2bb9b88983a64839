#include "body/mesh_moments_gradient.hpp"

#include "body/quadric_value.hpp"
#include "geometry/triangle.hpp"

namespace kreisel::core {

std::array<double, 3> means_with_hats(const Moments& q, const std::array<Vec3, 3>& corners) {
  // q over the triangle: its values at the corners, and 4 q(middle) - q - q of the side across from each,
  // which is twice the Bernstein coefficient there.
  std::array<double, 3> value{}, across{}, means{};
  for (std::size_t k = 0; k < 3; ++k) value[k] = quadric_value(q, corners[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    across[k] = 4 * quadric_value(q, (corners[i] + corners[j]) / 2) - value[i] - value[j];
  }
  // With hat functions a, b, c: the mean of a^3 is 1/10, of a^2 b 1/30, of a b c 1/60.
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    means[k] = value[k] / 10 + (value[i] + value[j] + across[i] + across[j]) / 30 + across[k] / 60;
  }
  return means;
}

std::vector<Vec3> reference::mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q) {
  std::vector<Vec3> gradient(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const auto corners = corners_of(mesh, t);
    const Vec3 area = normal_of(corners[0], corners[1], corners[2]) / 2;
    const std::array<double, 3> means = means_with_hats(q, corners);
    for (std::size_t k = 0; k < 3; ++k) gradient[t[k]] += means[k] * area;
  }
  return gradient;
}

}  // namespace kreisel::core
