// envelope.hpp - feasibility by two depth envelopes a view (nest_envelope.cl).
#pragma once

#include "nest/decide/views.hpp"

namespace kreisel::core::nest {

/// Valid unless some pixel has max w_B >= min w_A, no A, or a front-facing nearest A: the same answer as
/// peeling, to the pixel, from one pass over the triangles. docs/nesting.md has the proof and the accuracy.
class Envelope : public Sampled {
 public:
  Envelope(device::Device& device, const Nesting& nesting, int resolution);

  [[nodiscard]] std::string_view name() const override { return "envelope"; }

 private:
  /// The first bad pixel is that of the lowest row, then the lowest x, of half 0, else of half 1.
  Verdict draw() override;
  void draw_map() override;

  NestRaster raster_;
  int in_flight_;  ///< items of a launch
  cl::Buffer depth_, bad_;
  cl::Kernel kernel_;
};

}  // namespace kreisel::core::nest
