#include "nest/decide/peel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "device/program.hpp"
#include "error.hpp"
#include "nest/decide/depth_key.hpp"

namespace kreisel::core::nest {
namespace {

constexpr cl_uint behind_all = 0xffffffffu;

void require_memory(const device::Device& device, std::size_t pixels, int resolution) {
  const double bytes = 2.0 * double(pixels) * (4 * sizeof(cl_uint) + 1);
  const auto have = double(device.info().memory_bytes);
  if (bytes > 0.8 * have)
    throw InputError(
        fmt::format("resolution {}: peeling keeps {:.1f} GiB of layers, the device has {:.1f}; expected "
                    "a coarser one, or envelope",
                    resolution, bytes / (1 << 30), have / (1 << 30)));
}

}  // namespace

Peel::Peel(device::Device& device, const Nesting& nesting, int resolution)
    : Sampled(device, nesting, resolution), raster_(views_.raster()) {
  require_memory(device, views_.pixels(), resolution);
  const cl::Program program = device::build(device, "nest_peel");
  draw_depth_ = cl::Kernel(program, "nest_peel_depth");
  draw_colour_ = cl::Kernel(program, "nest_peel_colour");
  rules_ = cl::Kernel(program, "nest_peel_rules");
  device::checked("allocating layers", [&] {
    for (int k = 0; k < 2; ++k) {
      depth_[k] = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 2 * views_.pixels() * sizeof(cl_uint));
      colour_[k] = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 2 * views_.pixels() * sizeof(cl_uint));
    }
    state_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 4 * sizeof(cl_int));
    map_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 2 * views_.pixels());
  });
  views_.set_arguments(draw_depth_, 1);
  views_.set_arguments(draw_colour_, 1);
}

Verdict Peel::peel(bool whole) {
  device::Device& device = views_.device();
  const cl::CommandQueue& queue = device.queue();
  const std::size_t bytes = 2 * views_.pixels() * sizeof(cl_uint);
  const auto triangles = std::size_t(2 * raster_.triangles);
  for (cl::Kernel* kernel : {&draw_depth_, &draw_colour_, &rules_})
    kernel->setArg(0, sizeof raster_, &raster_);
  rules_.setArg(3, state_);
  rules_.setArg(4, map_);
  return device::checked("peeling", [&]() -> Verdict {
    queue.enqueueFillBuffer(depth_[0], cl_uint{0}, 0, bytes);
    queue.enqueueFillBuffer(colour_[0], cl_uint{0}, 0, bytes);
    queue.enqueueFillBuffer(map_, cl_uchar{NEST_GOOD}, 0, 2 * views_.pixels());
    for (int layer = 0;; ++layer) {
      const int last = layer % 2, now = 1 - last;
      constexpr cl_int none = std::numeric_limits<cl_int>::max();
      std::array<cl_int, 4> state{none, none, 0, 0};
      queue.enqueueWriteBuffer(state_, CL_FALSE, 0, sizeof state, state.data());
      queue.enqueueFillBuffer(depth_[now], behind_all, 0, bytes);
      queue.enqueueFillBuffer(colour_[now], cl_uint{0}, 0, bytes);
      draw_depth_.setArg(4, depth_[last]);
      draw_depth_.setArg(5, depth_[now]);
      device.run(draw_depth_, triangles, 64);
      draw_colour_.setArg(4, depth_[now]);
      draw_colour_.setArg(5, colour_[now]);
      device.run(draw_colour_, triangles, 64);
      rules_.setArg(1, colour_[last]);
      rules_.setArg(2, colour_[now]);
      device.run(rules_, 2 * views_.pixels(), 64);
      queue.enqueueReadBuffer(state_, CL_TRUE, 0, sizeof state, state.data());
      layers_ = layer + 1;
      if (!whole)
        for (int half = 0; half < 2; ++half)
          if (state[std::size_t(half)] != none) return fault_at(half, state[std::size_t(half)], layer);
      if (!state[2]) return {};
    }
  });
}

Verdict Peel::fault_at(int half, int pixel, int layer) const {
  const cl::CommandQueue& queue = views_.device().queue();
  const std::size_t at = std::size_t(half) * views_.pixels() + std::size_t(pixel);
  cl_uchar fault = NEST_GOOD;
  queue.enqueueReadBuffer(map_, CL_TRUE, at, sizeof fault, &fault);
  // B is what comes second where A sweeps through it, else it comes first.
  const int now = 1 - layer % 2;
  cl_uint key = 0;
  queue.enqueueReadBuffer(depth_[fault == NEST_SWEPT ? now : 1 - now], CL_TRUE, at * sizeof key, sizeof key,
                          &key);
  return views_.fault_at(Fault(fault), half, pixel, double(depth_of(key)));
}

}  // namespace kreisel::core::nest
