#include "nest/decide/envelope.hpp"

#include <algorithm>
#include <limits>

#include "device/program.hpp"

namespace kreisel::core::nest {
namespace {

constexpr std::size_t tile_bytes = 3 * 16 * sizeof(float);
// Each item keeps its band of three envelopes here; what does not fit at once runs in turn.
constexpr std::size_t scratch_bytes = std::size_t{256} << 20;

/// As few bands as keep a CPU's threads busy, for each item goes through all triangles; a row of tiles each
/// on a GPU.
int bands_for(const device::Device& device, int tiles) {
  const int wanted = device.lanes() == 1 ? tiles : std::max(1, int(device.info().compute_units) / 2);
  const auto row_bytes = std::size_t(tiles) * tile_bytes;
  const int most_rows = int(std::max<std::size_t>(scratch_bytes / 4 / row_bytes, 1));
  return std::clamp((tiles + most_rows - 1) / most_rows, std::min(wanted, tiles), tiles);
}

}  // namespace

Envelope::Envelope(device::Device& device, const Nesting& nesting, int resolution)
    : Sampled(device, nesting, resolution), raster_(views_.raster()) {
  const int wanted = bands_for(device, raster_.tiles);
  raster_.band = (raster_.tiles + wanted - 1) / wanted;
  raster_.bands = (raster_.tiles + raster_.band - 1) / raster_.band;
  const std::size_t item_bytes = std::size_t(raster_.tiles) * std::size_t(raster_.band) * tile_bytes;
  in_flight_ = int(std::clamp<std::size_t>(scratch_bytes / item_bytes, 1, std::size_t(2 * raster_.bands)));
  kernel_ = cl::Kernel(device::build(device, "nest_envelope"), "nest_envelope");
  device::checked("allocating depth envelopes", [&] {
    depth_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, item_bytes * std::size_t(in_flight_));
    bad_ = cl::Buffer(device.context(), CL_MEM_WRITE_ONLY, std::size_t(2 * raster_.bands) * sizeof(cl_int4));
    map_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, 4);
  });
  views_.set_arguments(kernel_, 1);
  kernel_.setArg(4, depth_);
  kernel_.setArg(5, bad_);
}

Verdict Envelope::draw() {
  device::Device& device = views_.device();
  std::vector<cl_int4> bad(std::size_t(2 * raster_.bands));
  kernel_.setArg(6, map_);
  for (raster_.first_item = 0; raster_.first_item < 2 * raster_.bands; raster_.first_item += in_flight_) {
    kernel_.setArg(0, sizeof raster_, &raster_);
    device.run(kernel_, NEST_SPREAD * std::size_t(in_flight_), 1);
  }
  device::checked("reading the bad pixels", [&] {
    device.queue().enqueueReadBuffer(bad_, CL_TRUE, 0, bad.size() * sizeof(cl_int4), bad.data());
  });
  for (std::size_t item = 0; item < bad.size(); ++item) {  // in the order of halves and rows
    if (bad[item].s[1] == NEST_GOOD) continue;
    float w = 0;
    std::copy_n(reinterpret_cast<const char*>(&bad[item].s[2]), sizeof w, reinterpret_cast<char*>(&w));
    return views_.fault_at(Fault(bad[item].s[1]), int(item) / raster_.bands, bad[item].s[0], w);
  }
  return {};
}

void Envelope::draw_map() {
  const cl::CommandQueue& queue = views_.device().queue();
  map_ = cl::Buffer(views_.device().context(), CL_MEM_READ_WRITE, 2 * views_.pixels());
  queue.enqueueFillBuffer(map_, cl_uchar{NEST_GOOD}, 0, 2 * views_.pixels());
  raster_.map = 1;
  (void)draw();
  raster_.map = 0;
}

}  // namespace kreisel::core::nest
