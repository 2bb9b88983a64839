#include "formulation/cell_moments.hpp"

#include <algorithm>
#include <utility>

#include "cell_moments_params.h"
#include "device/program.hpp"

namespace kreisel::core {
namespace {

using device::checked;

/// Words of the runs; the kernel may load some beyond the last.
template <class Value>
cl::Buffer upload_runs(device::Device& device, const Columns& domain, Value value) {
  constexpr std::size_t beyond = 8;
  std::vector<std::uint32_t> words;
  words.reserve(domain.intervals.size() + beyond);
  for (const Interval& run : domain.intervals) words.push_back(static_cast<std::uint32_t>(value(run)));
  words.resize(words.size() + beyond);
  return upload_words(device, words);
}

/// What the kernel sums of one cube.
CubeSums sums_on_host(const Columns& domain, const std::vector<std::uint32_t>& first, const Cube& cube) {
  const int nx = domain.grid.n[0], left = std::min<int>(cube.x, nx), right = std::min(cube.x + cube.edge, nx);
  CubeSums s{};
  for (int iy = cube.y; iy < std::min(cube.y + cube.edge, domain.grid.n[1]); ++iy) {
    const std::size_t row = static_cast<std::size_t>(nx) * iy;
    const auto j = static_cast<std::uint64_t>(iy - cube.y);
    for (std::uint32_t r = first[row + left]; r < first[row + right]; ++r) {
      const Interval& run = domain.intervals[r];
      const auto a = static_cast<std::uint64_t>(std::clamp<int>(run.k0 - cube.z, 0, cube.edge)),
                 b = static_cast<std::uint64_t>(std::clamp<int>(run.k1 - cube.z, 0, cube.edge)), n = b - a,
                 i = static_cast<std::uint64_t>(run.ix - cube.x);
      if (n == 0) continue;
      const std::uint64_t k = (a + b - 1) * n / 2;
      s[S1] += n;
      s[SX] += i * n;
      s[SY] += j * n;
      s[SZ] += k;
      s[SXY] += i * j * n;
      s[SYZ] += j * k;
      s[SXZ] += i * k;
      s[SXX] += i * i * n;
      s[SYY] += j * j * n;
      s[SZZ] += n * (2 * (a * a + a * b + b * b) - 3 * (a + b) + 1) / 6;
    }
  }
  return s;
}

}  // namespace

CubeSums full_cube(int edge) {
  const auto n = static_cast<std::uint64_t>(edge), k = n * (n - 1) / 2, kk = n * (n - 1) * (2 * n - 1) / 6;
  return {n * n * n, n * n * k, n * n * k,  n * n * k,  n * k * k,
          n * k * k, n * k * k, n * n * kk, n * n * kk, n * n * kk};
}

CubeSums in_parent(const CubeSums& s, const Cube& cube) {
  const std::uint64_t x = cube.x & cube.edge, y = cube.y & cube.edge,
                      z = cube.z & cube.edge;  // 0 or the edge
  return {s[S1],
          s[SX] + x * s[S1],
          s[SY] + y * s[S1],
          s[SZ] + z * s[S1],
          s[SXY] + x * s[SY] + y * s[SX] + x * y * s[S1],
          s[SYZ] + y * s[SZ] + z * s[SY] + y * z * s[S1],
          s[SXZ] + x * s[SZ] + z * s[SX] + x * z * s[S1],
          s[SXX] + 2 * x * s[SX] + x * x * s[S1],
          s[SYY] + 2 * y * s[SY] + y * y * s[S1],
          s[SZZ] + 2 * z * s[SZ] + z * z * s[S1]};
}

Moments moments_of(const Grid& grid, const Cube& cube, const CubeSums& sums) {
  const double h = grid.h, x = grid.centre(0, cube.x), y = grid.centre(1, cube.y), z = grid.centre(2, cube.z);
  Moments s;  // of voxels of unit volume at (i, j, k) h from the corner one
  for (int k = 0; k < 10; ++k) s[k] = static_cast<double>(sums[static_cast<std::size_t>(k)]);
  for (const int k : {SXX, SYY, SZZ}) s[k] += s[S1] / 12;  // a voxel's own extent
  s.segment<3>(SX) *= h;
  s.tail<6>() *= h * h;
  const double n = s[S1];
  Moments moved;
  moved << n, s[SX] + x * n, s[SY] + y * n, s[SZ] + z * n, s[SXY] + x * s[SY] + y * s[SX] + x * y * n,
      s[SYZ] + y * s[SZ] + z * s[SY] + y * z * n, s[SXZ] + x * s[SZ] + z * s[SX] + x * z * n,
      s[SXX] + 2 * x * s[SX] + x * x * n, s[SYY] + 2 * y * s[SY] + y * y * n,
      s[SZZ] + 2 * z * s[SZ] + z * z * n;
  return h * h * h * moved;
}

std::vector<std::uint32_t> first_runs(const Columns& domain) {
  const auto nx = static_cast<std::size_t>(domain.grid.n[0]);
  std::vector<std::uint32_t> first(nx * static_cast<std::size_t>(domain.grid.n[1]) + 1);
  for (const Interval& run : domain.intervals) ++first[run.ix + nx * run.iy + 1];
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  return first;
}

CellMoments::CellMoments(device::Device& device, const Columns& domain, std::size_t few)
    : device_(&device),
      domain_(&domain),
      few_(few),
      first_(first_runs(domain)),
      first_on_device_(upload_words(device, first_)),
      ix_(upload_runs(device, domain, [](const Interval& run) { return run.ix; })),
      low_(upload_runs(device, domain, [](const Interval& run) { return run.k0; })),
      high_(upload_runs(device, domain, [](const Interval& run) { return run.k1; })),
      kernel_(device::build(device, "cell_moments"), "cell_moments") {
  kernel_.setArg(2, first_on_device_);
  kernel_.setArg(3, ix_);
  kernel_.setArg(4, low_);
  kernel_.setArg(5, high_);
}

std::vector<CubeSums> CellMoments::operator()(std::span<const Cube> cubes) {
  std::vector<CubeSums> sums(cubes.size());
  std::size_t columns = 0;
  for (const Cube& cube : cubes) columns += std::size_t{cube.edge} * cube.edge;
  if (columns <= few_) {
    for (std::size_t c = 0; c < cubes.size(); ++c) sums[c] = sums_on_host(*domain_, first_, cubes[c]);
    return sums;
  }
  const auto buffer = [&](cl_mem_flags flags, std::size_t bytes) {
    return checked("allocating device arrays", [&] { return cl::Buffer(device_->context(), flags, bytes); });
  };
  const cl::Buffer corners = buffer(CL_MEM_READ_ONLY, cubes.size_bytes()),
                   out = buffer(CL_MEM_WRITE_ONLY, sums.size() * sizeof(CubeSums));
  checked("writing a device array", [&] {
    device_->queue().enqueueWriteBuffer(corners, CL_FALSE, 0, cubes.size_bytes(), cubes.data());
  });
  kernel_.setArg(1, corners);
  kernel_.setArg(6, out);
  device::set_params<CellParams>(*device_, kernel_, 0, [&](auto& p) {
    p.nx = domain_->grid.n[0];
    p.ny = domain_->grid.n[1];
    p.n = static_cast<int>(cubes.size());
  });
  device_->run(kernel_, device::padded(cubes.size()), device::padding);
  checked("reading a device array", [&] {
    device_->queue().enqueueReadBuffer(out, CL_TRUE, 0, sums.size() * sizeof(CubeSums), sums.data());
  });
  return sums;
}

namespace reference {

std::vector<Moments> cell_moments(const Columns& domain, std::span<const Cube> cubes) {
  const Grid& grid = domain.grid;
  const std::vector<std::uint32_t> first = first_runs(domain);
  std::vector<Moments> all(cubes.size(), Moments::Zero());
  for (std::size_t c = 0; c < cubes.size(); ++c) {
    const Cube& cube = cubes[c];
    const int bottom = cube.z, top = cube.z + cube.edge;
    for (int iy = cube.y; iy < std::min(cube.y + cube.edge, grid.n[1]); ++iy)
      for (int ix = cube.x; ix < std::min(cube.x + cube.edge, grid.n[0]); ++ix) {
        const std::size_t column = ix + static_cast<std::size_t>(grid.n[0]) * iy;
        for (std::uint32_t r = first[column]; r < first[column + 1]; ++r) {
          const int k0 = std::max(domain.intervals[r].k0, bottom), k1 = std::min(domain.intervals[r].k1, top);
          if (k0 >= k1) continue;
          const double length = grid.h * (k1 - k0);
          all[c] += box_moments({grid.centre(0, ix), grid.centre(1, iy), grid.face(2, k0) + length / 2},
                                {grid.h, grid.h, length});
        }
      }
  }
  return all;
}

}  // namespace reference
}  // namespace kreisel::core
