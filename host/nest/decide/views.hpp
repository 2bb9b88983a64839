// views.hpp - both meshes on the device, and their vertices in the two views of a placement
// (nest_project.cl).
#pragma once

#include <cstdint>
#include <optional>

#include "device/device.hpp"
#include "nest/decide/feasibility.hpp"
#include "nest_raster_params.h"

namespace kreisel::core::nest {

/// The pixels of one half's view: orthographic along the removal direction, square, as tight about A's box.
struct View {
  Eigen::Matrix3d axes;  ///< rows: along x, along y, along the removal direction; right-handed
  double x0, y0;         ///< lower left corner along the first two
  double pixel;          ///< a side of one, nesting units

  View(const Nesting& nesting, const Vec3& removal, int resolution);
  /// The point at depth w of a pixel's centre.
  [[nodiscard]] Vec3 point(int x, int y, double w) const;
};

/// What `peel` and `envelope` share: meshes, views and projected vertices.
class Views {
 public:
  /// @throws InputError  resolution out of [1, 16384]
  Views(device::Device& device, const Nesting& nesting, int resolution);

  /// Projects both meshes for a placement. @return a fault if B leaves a view: then nothing may be drawn
  Verdict project(const Placement& placement);

  /// A fault at a pixel. @param w  depth of T(B) there
  [[nodiscard]] Verdict fault_at(Fault fault, int half, int pixel, double w) const;

  [[nodiscard]] const NestRaster& raster() const { return raster_; }
  [[nodiscard]] device::Device& device() const { return *device_; }
  [[nodiscard]] std::size_t pixels() const { return std::size_t(raster_.width) * std::size_t(raster_.width); }
  /// Sets arguments view, point, corner from `first` on.
  void set_arguments(cl::Kernel& kernel, unsigned first) const;

 private:
  device::Device* device_;
  const Nesting* nesting_;
  NestRaster raster_{};
  TriangleMesh inner_;  ///< in the device's order
  std::vector<View> views_;
  cl::Buffer vertex_, corner_, view_, point_, outside_;
  cl::Kernel project_;
};

/// Why each pixel is bad, of half 0 and then of half 1; x fastest. Empty when B leaves a view.
using FaultMap = std::vector<std::uint8_t>;

/// A test of the pixels of both views.
class Sampled : public Feasibility {
 public:
  using Feasibility::check;
  [[nodiscard]] Verdict check(const Placement& placement) override;
  [[nodiscard]] FaultMap map(const Placement& placement);

 protected:
  /// @throws InputError  resolution out of range
  /// @throws device::Error  the device refuses
  Sampled(device::Device& device, const Nesting& nesting, int resolution)
      : views_(device, nesting, resolution) {}

  /// Of the placement that was projected last: its first bad pixel.
  virtual Verdict draw() = 0;
  /// The same with all of them in map_, a byte each.
  virtual void draw_map() = 0;

  Views views_;
  cl::Buffer map_;
};

}  // namespace kreisel::core::nest
