// single_precision.hpp - coordinates as files in single precision keep them.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The nearest number in single precision. By way of memory: where two neighbours are rounded at once, GCC 12
/// (-O2, -O3) takes the conversion there and back for nothing and leaves it out.
[[nodiscard]] inline double in_single_precision(double x) {
  const volatile float narrow = static_cast<float>(x);
  return static_cast<double>(narrow);
}

[[nodiscard]] inline Vec3 in_single_precision(const Vec3& v) {
  return {in_single_precision(v[0]), in_single_precision(v[1]), in_single_precision(v[2])};
}

[[nodiscard]] inline TriangleMesh in_single_precision(TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = in_single_precision(v);
  return mesh;
}

}  // namespace kreisel::core
