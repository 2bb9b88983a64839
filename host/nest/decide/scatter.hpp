// scatter.hpp - feasibility by two depth envelopes a view, on a device of many threads (nest_scatter.cl).
#pragma once

#include "nest/decide/views.hpp"

namespace kreisel::core::nest {

/// What Envelope answers, to the pixel and the last bit. There an item goes through all triangles of a band
/// of rows, as suits a few fast threads; here each takes one triangle, as suits thousands of slow ones.
class Scatter : public Feasibility {
 public:
  /// @throws InputError  resolution out of range
  /// @throws device::Error  the device refuses
  Scatter(device::Device& device, const Nesting& nesting, int resolution);

  /// Of the device's memory.
  [[nodiscard]] static double bytes(int resolution) { return 2.0 * resolution * resolution * 13; }

  [[nodiscard]] std::string_view name() const override { return "envelope"; }
  using Feasibility::check;
  /// The first bad pixel is that of the lowest row, then the lowest x, of half 0, else of half 1.
  [[nodiscard]] Verdict check(const Placement& placement) override;
  [[nodiscard]] FaultMap map(const Placement& placement);

 private:
  Verdict draw();

  Views views_;
  cl::Buffer b_, back_, front_, first_, map_;
  cl::Kernel scatter_, rules_;
};

}  // namespace kreisel::core::nest
