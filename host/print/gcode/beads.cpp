#include "print/gcode/beads.hpp"

#include <cmath>

namespace kreisel::core {

void Beads::add_line(const Vec3& from, const Vec3& to, double filament, double height) {
  const Vec3 d = to - from;
  const double across = d[0] * d[0] + d[1] * d[1];  // squared length in the plane
  if (!(across > 0)) return add_blob(0.5 * (from + to), filament, height);
  Vec3 c = 0.5 * (from + to);
  c[2] -= 0.5 * height;
  // A box spanned by three vectors a: V (c c^T + sum a a^T / 12).
  constexpr double twelfth = 1.0 / 12;
  Moments& s = by_area_;
  s[S1] += filament;
  s[SX] += filament * c[0];
  s[SY] += filament * c[1];
  s[SZ] += filament * c[2];
  s[SXY] += filament * (c[0] * c[1] + twelfth * d[0] * d[1]);
  s[SYZ] += filament * (c[1] * c[2] + twelfth * d[1] * d[2]);
  s[SXZ] += filament * (c[0] * c[2] + twelfth * d[0] * d[2]);
  s[SXX] += filament * (c[0] * c[0] + twelfth * d[0] * d[0]);
  s[SYY] += filament * (c[1] * c[1] + twelfth * d[1] * d[1]);
  s[SZZ] += filament * (c[2] * c[2] + twelfth * (d[2] * d[2] + height * height));
  // The width vector is at right angles to d in the plane; its length is V / (length height).
  const double over = filament / (height * across);
  const double cube = twelfth * filament * over * over;
  by_cube_[SXX] += cube * d[1] * d[1];
  by_cube_[SYY] += cube * d[0] * d[0];
  by_cube_[SXY] -= cube * d[0] * d[1];
}

void Beads::add_arc(const Vec3& from, const Vec3& to, const Vec3& centre, double angle, double filament,
                    double height) {
  const double r = std::hypot(from[0] - centre[0], from[1] - centre[1]);
  const double a0 = std::atan2(from[1] - centre[1], from[0] - centre[0]), a1 = a0 + angle;
  const double c0 = std::cos(a0), s0 = std::sin(a0), c1 = std::cos(a1), s1 = std::sin(a1);
  // Means along the arc, of cosine and sine, their products, and themselves times t, which goes from 0 to 1.
  const double c = (s1 - s0) / angle, s = (c0 - c1) / angle;
  const double cs = (s1 * s1 - s0 * s0) / (2 * angle);
  const double cc = 0.5 + (s1 * c1 - s0 * c0) / (2 * angle), ss = 1 - cc;
  const double tc = s1 / angle + (c1 - c0) / (angle * angle), ts = -c1 / angle + (s1 - s0) / (angle * angle);
  const double x = centre[0], y = centre[1], dz = to[2] - from[2];
  const double low = from[2] - 0.5 * height, z = low + 0.5 * dz;
  // Across the bead the mean of the distance from the axis is r + w^2 / (12 r), that of its square
  // r^2 + w^2 / 4: `ring` is multiplied by the first, `disc` by the second.
  Moments point = Moments::Zero(), ring = Moments::Zero(), disc = Moments::Zero();
  point << 1, x, y, z, x * y, y * z, x * z, x * x, y * y, z * z + dz * dz / 12 + height * height / 12;
  ring[SX] = c;
  ring[SY] = s;
  ring[SXY] = x * s + y * c;
  ring[SYZ] = low * s + dz * ts;
  ring[SXZ] = low * c + dz * tc;
  ring[SXX] = 2 * x * c;
  ring[SYY] = 2 * y * s;
  disc[SXY] = cs;
  disc[SXX] = cc;
  disc[SYY] = ss;
  by_area_ += filament * (point + r * ring + r * r * disc);
  const double over = filament / (r * angle * height);  // the width at area 1
  by_cube_ += filament * over * over * (ring / (12 * r) + 0.25 * disc);
}

void Beads::add_blob(const Vec3& at, double filament, double height) {
  const double x = at[0], y = at[1], z = at[2] - 0.5 * height;
  Moments s;
  s << 1, x, y, z, x * y, y * z, x * z, x * x, y * y, z * z + height * height / 12;
  by_area_ += filament * s;
}

Beads& Beads::operator+=(const Beads& other) {
  by_area_ += other.by_area_;
  by_cube_ += other.by_cube_;
  return *this;
}

}  // namespace kreisel::core
