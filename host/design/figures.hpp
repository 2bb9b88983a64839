// figures.hpp - a solid before and after, in the numbers that people go by.
#pragma once

#include "session/result.hpp"

namespace kreisel::core {

/// Of a whole solid: model coordinates, mm and g.
struct Figures {
  double mass = 0;
  double volume = 0;  ///< of the material
  Vec3 centre_of_mass = Vec3::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();   ///< about the centre of mass, model axes; g mm^2
  Vec3 principal = Vec3::Zero();                       ///< moments, ascending; g mm^2
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< unit vectors, one a column
  Verdict verdict;                                     ///< of the problem on this solid
};

/// @param body    moments in the frame and units of the run's body
/// @param volume  of the material, mm^3
[[nodiscard]] Figures figures_of(const Moments& body, double volume, const RunResult& run, Verdict verdict);

/// By how much a solid misses what was asked; NaN where nothing of the kind was.
struct Residual {
  /// From the axis, the axle's centre, the vertical or the point; of what is to stand anywhere inside its
  /// base, outside of it.
  double centre_of_mass_mm;
  double axis_degrees;  ///< between the axis and the nearest principal one
  double mass_g;        ///< of what floats, above the displaced fluid's
};

/// @param figures  with the verdict of the configuration's problem
[[nodiscard]] Residual residual_of(const Figures& figures, const RunConfig& config);

}  // namespace kreisel::core
