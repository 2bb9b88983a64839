#include "nest/decide/views.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "device/program.hpp"
#include "error.hpp"

namespace kreisel::core::nest {
namespace {

constexpr int finest = 16384;

/// A mesh in an order in which neighbours lie together, as the caches like it: vertices by the interleaved
/// bits of their places, triangles by the first of their vertices. Padded to whole groups of 16 vertices.
TriangleMesh sorted(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  const double size = std::max(box.extent().maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 place = (mesh.vertices[i] - box.lo) / size * 1023;
    std::uint64_t code = 0;
    for (int bit = 9; bit >= 0; --bit)
      for (int axis = 0; axis < 3; ++axis) code = 2 * code + (std::uint64_t(place[axis]) >> bit & 1);
    order.emplace_back(code, i);
  }
  std::sort(order.begin(), order.end());
  TriangleMesh out;
  std::vector<std::uint32_t> place(order.size());
  for (const auto& [code, i] : order) {
    place[i] = std::uint32_t(out.vertices.size());
    out.vertices.push_back(mesh.vertices[i]);
  }
  while (out.vertices.size() % 16) out.vertices.push_back(out.vertices.back());
  for (const Triangle& t : mesh.triangles) out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  std::sort(out.triangles.begin(), out.triangles.end(), [](const Triangle& t, const Triangle& u) {
    const std::uint32_t a = std::min({t[0], t[1], t[2]}), b = std::min({u[0], u[1], u[2]});
    return a != b ? a < b : t < u;
  });
  return out;
}

/// All x, all y, all z.
std::vector<float> coordinates_of(const TriangleMesh& outer, const TriangleMesh& inner) {
  std::vector<float> out;
  for (int axis = 0; axis < 3; ++axis)
    for (const TriangleMesh* mesh : {&outer, &inner})
      for (const Vec3& v : mesh->vertices) out.push_back(float(v[axis]));
  return out;
}

std::vector<std::uint32_t> corners_of(const TriangleMesh& outer, const TriangleMesh& inner) {
  std::vector<std::uint32_t> out;
  for (const Triangle& t : outer.triangles) out.insert(out.end(), t.begin(), t.end());
  for (const Triangle& t : inner.triangles)
    for (const std::uint32_t v : t) out.push_back(std::uint32_t(outer.vertices.size()) + v);
  out.resize(out.size() + 15 * 3);  // nest_raster16.h reads whole groups of 16
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

View::View(const Nesting& nesting, const Vec3& removal, int resolution) : axes(axes_along(removal)) {
  const Box& box = nesting.outer_box();
  const Vec3 centre = axes * box.centre();
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
  const TriangleMesh outer = sorted(nesting.outer());
  inner_ = sorted(nesting.inner());
  raster_.inner = int(outer.vertices.size());
  raster_.vertices = raster_.inner + int(inner_.vertices.size());
  raster_.first_b = int(nesting.outer().triangles.size());
  raster_.triangles = raster_.first_b + int(nesting.inner().triangles.size());
  device::checked("loading the meshes of a nesting", [&] {
    vertex_ = constant(device, coordinates_of(outer, inner_));
    corner_ = constant(device, corners_of(outer, inner_));
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
    device_->run(project_, std::size_t(raster_.vertices) / 16, 8);
    queue.enqueueReadBuffer(outside_, CL_TRUE, 0, sizeof outside, &outside);
  });
  if (outside == inside) return {};
  // The vertex of the group that lies farthest from A's middle.
  const Pose& pose = placement.pose;
  Vec3 point = pose.centroid;
  for (std::size_t i = 0; i < 16; ++i) {
    const Vec3& b = inner_.vertices[16 * std::size_t(outside) - std::size_t(raster_.inner) + i];
    const Vec3 p = pose.scale * (pose.rotation * b) + pose.centroid;
    if (i == 0 || p.squaredNorm() > point.squaredNorm()) point = p;
  }
  return {Fault::outside, placement.cut.beyond(0, point) >= 0 ? 0 : 1, point};
}

Verdict Sampled::check(const Placement& placement) {
  const Verdict verdict = views_.project(placement);
  return verdict.valid() ? draw() : verdict;
}

FaultMap Sampled::map(const Placement& placement) {
  if (!views_.project(placement).valid()) return {};
  FaultMap map(2 * views_.pixels());
  device::checked("reading the bad pixels", [&] {
    draw_map();
    views_.device().queue().enqueueReadBuffer(map_, CL_TRUE, 0, map.size(), map.data());
  });
  return map;
}

Verdict Views::fault_at(Fault fault, int half, int pixel, double w) const {
  const int x = pixel % raster_.width, y = pixel / raster_.width;
  return {fault, half, views_[std::size_t(half)].point(x, y, w), x, y};
}

}  // namespace kreisel::core::nest
