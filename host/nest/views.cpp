#include "nest/views.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "device/program.hpp"
#include "error.hpp"

namespace kreisel::nest {
namespace {

constexpr int finest = 16384;

/// x y z 1 of all vertices, A's first.
std::vector<float> vertices_of(const Nesting& nesting) {
  std::vector<float> out;
  out.reserve(4 * (nesting.outer().vertices.size() + nesting.inner().vertices.size()));
  for (const TriangleMesh* mesh : {&nesting.outer(), &nesting.inner()})
    for (const Vec3& v : mesh->vertices) out.insert(out.end(), {float(v[0]), float(v[1]), float(v[2]), 1.0f});
  return out;
}

std::vector<std::uint32_t> corners_of(const Nesting& nesting) {
  std::vector<std::uint32_t> out;
  std::uint32_t first = 0;
  for (const TriangleMesh* mesh : {&nesting.outer(), &nesting.inner()}) {
    for (const Triangle& t : mesh->triangles)
      for (const std::uint32_t v : t) out.push_back(first + v);
    first += std::uint32_t(mesh->vertices.size());
  }
  return out;
}

template <class T>
cl::Buffer constant(device::Device& device, const std::vector<T>& values) {
  const std::size_t bytes = values.size() * sizeof(T);
  cl::Buffer buffer(device.context(), CL_MEM_READ_ONLY, bytes);
  device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, values.data());
  return buffer;
}

/// Rows of the kernel's arguments: pixels and depth of (x, y, z, 1). @param map  linear part, then shift
void write_rows(float* out, const View& view, const Eigen::Matrix3d& linear, const Vec3& shift) {
  const Eigen::Matrix3d m = view.axes * linear;
  const Vec3 s = view.axes * shift - Vec3(view.x0, view.y0, 0);
  for (int row = 0; row < 3; ++row) {
    const double unit = row < 2 ? view.pixel : 1;
    for (int k = 0; k < 3; ++k) out[4 * row + k] = float(m(row, k) / unit);
    out[4 * row + 3] = float(s[row] / unit);
  }
}

NestView arguments_of(const View& view, const Placement& placement) {
  const Cut& cut = placement.cut;
  const Pose& pose = placement.pose;
  NestView out{};
  write_rows(out.a, view, Eigen::Matrix3d::Identity(), Vec3::Zero());
  write_rows(out.b, view, pose.scale * pose.rotation, pose.centroid);
  const Vec3 n = view.axes * cut.normal;
  out.plane[0] = float((cut.offset - n[0] * view.x0 - n[1] * view.y0) / n[2]);
  out.plane[1] = float(-n[0] * view.pixel / n[2]);
  out.plane[2] = float(-n[1] * view.pixel / n[2]);
  return out;
}

}  // namespace

View::View(const Nesting& nesting, const Vec3& removal, int resolution) {
  const Vec3 u = removal.unitOrthogonal();
  axes << u.transpose(), removal.cross(u).transpose(), removal.transpose();
  const Box& box = nesting.outer_box();
  const Vec3 centre = axes * (0.5 * (box.lo + box.hi));
  const Vec3 half = axes.cwiseAbs() * (0.5 * box.extent());
  const double reach = std::max(half[0], half[1]);
  x0 = centre[0] - reach;
  y0 = centre[1] - reach;
  pixel = 2 * reach / resolution;
}

Vec3 View::point(int x, int y, double w) const {
  return axes.transpose() * Vec3(x0 + pixel * (x + 0.5), y0 + pixel * (y + 0.5), w);
}

Views::Views(device::Device& device, const Nesting& nesting, int resolution)
    : device_(&device), nesting_(&nesting) {
  if (resolution < 1 || resolution > finest)
    throw InputError(fmt::format("resolution {}; expected 1 to {} pixels", resolution, finest));
  raster_.width = resolution;
  raster_.tiles = (resolution + 3) / 4;
  raster_.inner = int(nesting.outer().vertices.size());
  raster_.vertices = raster_.inner + int(nesting.inner().vertices.size());
  raster_.first_b = int(nesting.outer().triangles.size());
  raster_.triangles = raster_.first_b + int(nesting.inner().triangles.size());
  device::checked("loading the meshes of a nesting", [&] {
    vertex_ = constant(device, vertices_of(nesting));
    corner_ = constant(device, corners_of(nesting));
    view_ = cl::Buffer(device.context(), CL_MEM_READ_ONLY, 2 * sizeof(NestView));
    point_ =
        cl::Buffer(device.context(), CL_MEM_READ_WRITE, std::size_t(2 * raster_.vertices) * sizeof(cl_int4));
    outside_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, sizeof(cl_int));
  });
  project_ = cl::Kernel(device::build(device, "nest_project"), "nest_project");
  project_.setArg(0, sizeof raster_, &raster_);
  project_.setArg(1, view_);
  project_.setArg(2, vertex_);
  project_.setArg(3, point_);
  project_.setArg(4, outside_);
}

void Views::set_arguments(cl::Kernel& kernel, unsigned first) const {
  kernel.setArg(first, view_);
  kernel.setArg(first + 1, point_);
  kernel.setArg(first + 2, corner_);
}

Verdict Views::project(const Placement& placement) {
  require_valid(placement);
  views_ = {View(*nesting_, placement.cut.plus, raster_.width),
            View(*nesting_, placement.cut.minus, raster_.width)};
  const std::array<NestView, 2> arguments{arguments_of(views_[0], placement),
                                          arguments_of(views_[1], placement)};
  cl_int outside = std::numeric_limits<cl_int>::max();
  const cl_int inside = outside;
  device::checked("projecting a nesting", [&] {
    const cl::CommandQueue& queue = device_->queue();
    queue.enqueueWriteBuffer(view_, CL_FALSE, 0, sizeof arguments, arguments.data());
    queue.enqueueWriteBuffer(outside_, CL_FALSE, 0, sizeof inside, &inside);
    device_->run(project_, std::size_t(2 * raster_.vertices), 64);
    queue.enqueueReadBuffer(outside_, CL_TRUE, 0, sizeof outside, &outside);
  });
  if (outside == inside) return {};
  const Pose& pose = placement.pose;
  const Vec3 point =
      pose.scale * (pose.rotation * nesting_->inner().vertices[std::size_t(outside - raster_.inner)]) +
      pose.centroid;
  return {Fault::outside_view, placement.cut.beyond(0, point) >= 0 ? 0 : 1, point};
}

Verdict Views::fault_at(Fault fault, int half, int pixel, double w) const {
  const int x = pixel % raster_.width, y = pixel / raster_.width;
  return {fault, half, views_[std::size_t(half)].point(x, y, w), x, y};
}

}  // namespace kreisel::nest
