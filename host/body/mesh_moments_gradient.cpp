#include "body/mesh_moments_gradient.hpp"

#include <algorithm>
#include <numeric>

#include "body/quadric_value.hpp"
#include "device/buffer.hpp"
#include "device/program.hpp"
#include "geometry/triangle.hpp"
#include "mesh_moments_gradient_params.h"

namespace kreisel::core {
namespace {

/// The triangles beside each vertex: where they begin, and the two other corners of each.
struct Beside {
  std::vector<std::uint32_t> first, others;

  explicit Beside(const TriangleMesh& mesh) : first(mesh.vertices.size() + 1, 0) {
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) ++first[v + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    others.resize(2 * std::size_t{first.back()});
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = 2 * std::size_t{next[t[k]]++};
        others[at] = t[(k + 1) % 3];
        others[at + 1] = t[(k + 2) % 3];
      }
  }
};

}  // namespace

std::vector<Vec3> mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q, device::Device& device) {
  const std::size_t n = mesh.vertices.size();
  if (mesh.triangles.empty()) return std::vector<Vec3>(n, Vec3::Zero());
  const Vec3 middle = bounding_box(mesh).centre();
  std::vector<double> quadruples(4 * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      quadruples[4 * i + k] =
          mesh.vertices[i][static_cast<Eigen::Index>(k)] - middle[static_cast<Eigen::Index>(k)];
  // q of x = x' + middle, as a quadric of x'.
  const Moments about = moment_map(Eigen::Matrix3d::Identity(), middle).transpose() * q;
  const Beside beside(mesh);
  const device::RealBuffer vertex(device, quadruples);
  const device::RealBuffer gradient(device, 4 * n);
  const cl::Buffer first = device::upload_words(device, beside.first),
                   others = device::upload_words(device, beside.others);
  cl::Kernel kernel(device::build(device, "mesh_moments_gradient"), "mesh_moments_gradient");
  device::set_params<MeshGradientParams>(device, kernel, 0, [&](auto& p) {
    for (int k = 0; k < 10; ++k) p.q[k] = static_cast<std::decay_t<decltype(p.q[0])>>(about[k]);
    p.n = static_cast<int>(n);
  });
  kernel.setArg(1, vertex.handle());
  kernel.setArg(2, first);
  kernel.setArg(3, others);
  kernel.setArg(4, gradient.handle());
  device.run(kernel, n, 64);
  gradient.download(quadruples);
  std::vector<Vec3> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = Vec3(quadruples.data() + 4 * i);
  return result;
}

double mesh_moments_gradient_bound(const TriangleMesh& mesh, const device::Device& device) {
  const Beside beside(mesh);
  std::uint32_t most = 0;
  for (std::size_t i = 1; i < beside.first.size(); ++i)
    most = std::max(most, beside.first[i] - beside.first[i - 1]);
  return (60 + most) * device.unit_roundoff();
}

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

reference::GradientSums reference::mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q) {
  GradientSums sums{std::vector<Vec3>(mesh.vertices.size(), Vec3::Zero()),
                    std::vector<double>(mesh.vertices.size(), 0.0)};
  for (const Triangle& t : mesh.triangles) {
    const auto corners = corners_of(mesh, t);
    const Vec3 area = normal_of(corners[0], corners[1], corners[2]) / 2;
    const std::array<double, 3> means = means_with_hats(q, corners);
    // The sides' products and q's own terms cancel, so they count by their absolute values.
    const double sides = (corners[1] - corners[0]).norm() * (corners[2] - corners[0]).norm() / 2;
    const Vec3 far = corners[0].cwiseAbs().cwiseMax(corners[1].cwiseAbs()).cwiseMax(corners[2].cwiseAbs());
    const double size = quadric_value(q.cwiseAbs(), far) * sides;
    for (std::size_t k = 0; k < 3; ++k) {
      sums.value[t[k]] += means[k] * area;
      sums.abs_sum[t[k]] += size;
    }
  }
  return sums;
}

}  // namespace kreisel::core
