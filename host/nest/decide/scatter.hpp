// scatter.hpp - feasibility by two depth envelopes a view, on a device of many threads (nest_scatter.cl).
#pragma once

#include "nest/decide/views.hpp"

namespace kreisel::core::nest {

/// What Envelope answers, to the pixel and the last bit. There an item goes through all triangles of a band
/// of rows, as suits a few fast threads; here each takes one triangle, as suits thousands of slow ones.
class Scatter : public Sampled {
 public:
  Scatter(device::Device& device, const Nesting& nesting, int resolution);

  /// Of the device's memory.
  [[nodiscard]] static double bytes(int resolution) { return 2.0 * resolution * resolution * 13; }

  [[nodiscard]] std::string_view name() const override { return "envelope"; }

 private:
  /// The first bad pixel is that of the lowest row, then the lowest x, of half 0, else of half 1.
  Verdict draw() override;
  void draw_map() override { (void)draw(); }

  cl::Buffer b_, back_, front_, first_;
  cl::Kernel scatter_, rules_;
};

}  // namespace kreisel::core::nest
