#include "problem/hang.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "physics/units.hpp"
#include "problem/ray_direction.hpp"

namespace kreisel::core {
namespace {

/// Model coordinates, mm.
struct Suspension {
  Vec3 point, up;
};

Suspension suspension_of(const Settings& settings, const Body& body) {
  const auto [point, line] = settings_as<LineSettings>(settings);
  const Vec3 up = line.value_or(body.usual.up);
  return {point ? *point : lowest_point(body.mesh, -up), up};
}

}  // namespace

Hang::Hang(const Vec3& point, const Vec3& up) : on_line_(point, up), constraints_(on_line_.constraints()) {
  LinearConstraints& c = constraints_;
  const Eigen::Index row = c.matrix.rows();
  c.matrix.conservativeResize(row + 1, Eigen::NoChange);
  c.lower.conservativeResize(row + 1);
  c.upper.conservativeResize(row + 1);
  const Vec3& e = *on_line_.direction();
  c.matrix.row(row).setZero();
  c.matrix.row(row).segment<3>(SX) = e.transpose();
  c.matrix(row, S1) = -e.dot(point);
  c.lower[row] = -std::numeric_limits<double>::infinity();
  c.upper[row] = 0;
  c.names.emplace_back("the centre of mass stays {} above the point");
}

Verdict Hang::verify(const Moments& s, double length_mm) const {
  const Vec3 from = centre_of_mass(s) - on_line_.point();
  const double below = -from.dot(*on_line_.direction());
  const double off = (from + below * *on_line_.direction()).norm();
  const double turn = degrees(std::atan2(off, below));
  Verdict verdict;
  verdict.ok = off <= 1e-3 && below > 0;
  verdict.values = {{"offset", off},         {"offset_mm", off * length_mm}, {"below_mm", below * length_mm},
                    {"turns_degrees", turn}, {"mass_share", s[S1]},          {"objective", value(s)}};
  verdict.text = fmt::format(
      "{}: centre of mass {:.3f} mm below the point and {:.3f} mm ({:.1e} L) off the vertical: it turns by "
      "{:.2f} "
      "degrees, with {:.1f} % of the material",
      verdict.ok ? "hangs" : "does not hang as posed", below * length_mm, off * length_mm, off, turn,
      100 * s[S1]);
  return verdict;
}

Fields<LineSettings> hang_fields() {
  return line_fields("from where it hangs, mm in model coordinates; default: the highest point",
                     "which way is up; default: the model's");
}

std::unique_ptr<Problem> make_hang(const Settings& settings, const Body& body) {
  const Suspension at = suspension_of(settings, body);
  return std::make_unique<Hang>(body.frame.to_body(at.point), body.frame.rotation * at.up);
}

std::optional<Vec3> rays_of_hang(const Settings& settings, const Body& body) {
  const Suspension at = suspension_of(settings, body);
  return rays_of_balance(LineSettings{at.point, at.up}, body);
}

}  // namespace kreisel::core
