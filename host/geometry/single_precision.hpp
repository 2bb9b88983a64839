// single_precision.hpp - coordinates as files in single precision keep them.
#pragma once

#include <cmath>

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

/// How far neighbouring numbers in single precision are apart, at a number of that size.
[[nodiscard]] inline double single_spacing(double size) {
  const float at = static_cast<float>(std::abs(size));
  return std::nextafter(at, std::numeric_limits<float>::infinity()) - at;
}

/// A place near what lies in the box, to be taken off its coordinates so that single precision holds them:
/// along each axis its middle in whole units, but 0 where that is no more than eight times its longest side.
/// Then neighbouring numbers are a millionth of that side apart or less anyway.
[[nodiscard]] inline Vec3 place_of(const Box& box) {
  const double near = 8 * box.extent().maxCoeff();
  return box.centre().unaryExpr(
      [&](double middle) { return std::abs(middle) > near ? in_single_precision(std::round(middle)) : 0.0; });
}

/// What single precision makes of a point about a place; and such that double precision, which is coarse far
/// from the origin, takes it there and back unchanged.
[[nodiscard]] inline Vec3 in_single_precision(const Vec3& v, const Vec3& place) {
  return in_single_precision(Vec3(Vec3(v + place) - place));
}
[[nodiscard]] inline TriangleMesh in_single_precision(TriangleMesh mesh, const Vec3& place) {
  for (Vec3& v : mesh.vertices) v = in_single_precision(v, place);
  return mesh;
}

}  // namespace kreisel::core
