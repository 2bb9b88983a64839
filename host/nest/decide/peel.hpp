// peel.hpp - feasibility by depth peeling (nest_peel.cl): the paper's method, the baseline.
#pragma once

#include "nest/decide/views.hpp"

namespace kreisel::core::nest {

/// Peels one layer of fragments after the other off both views and stops at the first that holds a bad pixel,
/// or when nothing is left. [Nest, s. 5]
class Peel : public Sampled {
 public:
  /// @throws InputError  resolution out of range, or finer than the device has memory for
  Peel(device::Device& device, const Nesting& nesting, int resolution);

  [[nodiscard]] std::string_view name() const override { return "peel"; }
  /// Layers of the last check, the one that found nothing included.
  [[nodiscard]] int layers() const { return layers_; }

 private:
  /// The first bad pixel is that of the first layer that has one: of half 0, else of half 1, the lowest row,
  /// then the lowest x.
  Verdict draw() override { return peel(false); }
  /// Peels to the end. Of each pixel the first fault counts.
  void draw_map() override { (void)peel(true); }
  Verdict peel(bool whole);
  [[nodiscard]] Verdict fault_at(int half, int pixel, int layer) const;

  NestRaster raster_;
  int layers_ = 0;
  cl::Buffer depth_[2], colour_[2], state_;
  cl::Kernel draw_depth_, draw_colour_, rules_;
};

}  // namespace kreisel::core::nest
