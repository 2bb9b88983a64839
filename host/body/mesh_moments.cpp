#include "body/mesh_moments.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "device/buffer.hpp"
#include "device/program.hpp"
#include "geometry/triangle.hpp"
#include "mesh_moments_params.h"

namespace kreisel::core {
namespace {

constexpr std::size_t most_vertices = (std::size_t{1} << 30) - 1;  // quadruples are found by 32-bit words

/// x, y, z, 0 of every vertex about `middle`, and of `middle` itself at the end.
std::vector<double> quadruples(const TriangleMesh& mesh, const Vec3& middle) {
  std::vector<double> all(4 * (mesh.vertices.size() + 1), 0.0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int k = 0; k < 3; ++k) all[4 * i + static_cast<std::size_t>(k)] = mesh.vertices[i][k] - middle[k];
  return all;
}

/// Where first, second, third corners of all triangles begin among the quadruples, one after the other;
/// padded with triangles at the middle.
std::vector<std::uint32_t> corners_apart(const TriangleMesh& mesh) {
  const std::size_t n = device::padded(mesh.triangles.size());
  std::vector<std::uint32_t> all(3 * n, static_cast<std::uint32_t>(4 * mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) all[k * n + i] = 4 * mesh.triangles[i][k];
  return all;
}

}  // namespace

Moments mesh_moments(const TriangleMesh& mesh, device::Device& device) {
  if (mesh.triangles.empty()) return Moments::Zero();
  if (mesh.vertices.size() > most_vertices)
    throw std::invalid_argument(
        fmt::format("mesh of {} vertices; the kernel takes at most {}", mesh.vertices.size(), most_vertices));
  const Vec3 middle = bounding_box(mesh).centre();
  const std::vector<double> vertices = quadruples(mesh, middle);
  const std::vector<std::uint32_t> corners = corners_apart(mesh);
  const device::RealBuffer vertex(device, vertices);
  const cl::Buffer corner = device::upload_words(device, corners);
  device::PartialRows rows(device, mesh.triangles.size());
  cl::Kernel kernel(device::build(device, "mesh_moments"), "mesh_moments");
  device::set_params<MeshParams>(device, kernel, 0, [&](auto& p) {
    p.n = static_cast<int>(corners.size() / 3);
    p.block = rows.block();
  });
  kernel.setArg(1, vertex.handle());
  kernel.setArg(2, corner);
  kernel.setArg(3, rows.handle());
  rows.run(kernel);
  const auto joined = rows.join();
  Moments sums(joined.data());
  sums[S1] /= 6;
  sums.segment<3>(SX) /= 24;
  sums.tail<6>() /= 120;
  return transformed(sums, Eigen::Matrix3d::Identity(), middle);
}

double mesh_moments_bound(const TriangleMesh& mesh, device::Device& device) {
  return 40 * device.unit_roundoff() + device::PartialRows(device, mesh.triangles.size()).summation_bound();
}

namespace reference {

namespace {

/// Of the tetrahedron between the origin and three corners. @param volume  det(a, b, c) / 6
Moments terms(double volume, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 total = a + b + c;
  const auto second = [&](int i, int j) {
    return (total[i] * total[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) / 20;
  };
  Moments term;
  term << 1, total / 4, second(0, 1), second(1, 2), second(0, 2), second(0, 0), second(1, 1), second(2, 2);
  return volume * term;
}

}  // namespace

MomentSums mesh_moments(const TriangleMesh& mesh) {
  MomentSums sum;
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, t);
    sum.value += terms(a.dot(b.cross(c)) / 6, a, b, c);
    // The determinant's own cancellation counts too, so its six products enter by absolute value.
    const Vec3 ua = a.cwiseAbs(), ub = b.cwiseAbs(), uc = c.cwiseAbs();
    const double volume = (ua[0] * (ub[1] * uc[2] + ub[2] * uc[1]) + ua[1] * (ub[2] * uc[0] + ub[0] * uc[2]) +
                           ua[2] * (ub[0] * uc[1] + ub[1] * uc[0])) /
                          6;
    sum.abs_sum += terms(volume, ua, ub, uc);
  }
  return sum;
}

}  // namespace reference
}  // namespace kreisel::core
