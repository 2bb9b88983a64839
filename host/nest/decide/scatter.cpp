#include "nest/decide/scatter.hpp"

#include <array>
#include <limits>

#include "device/program.hpp"
#include "nest/decide/depth_key.hpp"

namespace kreisel::core::nest {

Scatter::Scatter(device::Device& device, const Nesting& nesting, int resolution)
    : Sampled(device, nesting, resolution) {
  const cl::Program program = device::build(device, "nest_scatter");
  scatter_ = cl::Kernel(program, "nest_scatter");
  rules_ = cl::Kernel(program, "nest_scatter_rules");
  device::checked("allocating depth envelopes", [&] {
    for (cl::Buffer* depths : {&b_, &back_, &front_})
      *depths = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 2 * views_.pixels() * sizeof(cl_uint));
    first_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 2 * sizeof(cl_int));
    map_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 2 * views_.pixels());
  });
  scatter_.setArg(0, sizeof views_.raster(), &views_.raster());
  views_.set_arguments(scatter_, 1);
  rules_.setArg(0, sizeof views_.raster(), &views_.raster());
  for (unsigned k = 0; cl::Buffer * depths : {&b_, &back_, &front_}) {
    scatter_.setArg(4 + k, *depths);
    rules_.setArg(1 + k, *depths);
    ++k;
  }
  rules_.setArg(4, first_);
  rules_.setArg(5, map_);
}

Verdict Scatter::draw() {
  device::Device& device = views_.device();
  const cl::CommandQueue& queue = device.queue();
  return device::checked("drawing depth envelopes", [&]() -> Verdict {
    constexpr cl_int none = std::numeric_limits<cl_int>::max();
    constexpr cl_uint behind_all = std::numeric_limits<cl_uint>::max();
    const std::size_t bytes = 2 * views_.pixels() * sizeof(cl_uint);
    std::array<cl_int, 2> first{};
    queue.enqueueFillBuffer(b_, cl_uint{0}, 0, bytes);
    queue.enqueueFillBuffer(back_, behind_all, 0, bytes);
    queue.enqueueFillBuffer(front_, behind_all, 0, bytes);
    queue.enqueueFillBuffer(first_, none, 0, sizeof first);
    device.run(scatter_, 2 * std::size_t(views_.raster().triangles), 64);
    device.run(rules_, 2 * views_.pixels(), 64);
    queue.enqueueReadBuffer(first_, CL_TRUE, 0, sizeof first, first.data());
    for (int half = 0; half < 2; ++half) {
      const cl_int pixel = first[std::size_t(half)];
      if (pixel == none) continue;
      const std::size_t at = std::size_t(half) * views_.pixels() + std::size_t(pixel);
      cl_uchar fault = NEST_GOOD;
      cl_uint key = 0;
      queue.enqueueReadBuffer(map_, CL_TRUE, at, sizeof fault, &fault);
      queue.enqueueReadBuffer(b_, CL_TRUE, at * sizeof key, sizeof key, &key);
      return views_.fault_at(Fault(fault), half, pixel, double(depth_of(key)));
    }
    return {};
  });
}

}  // namespace kreisel::core::nest
