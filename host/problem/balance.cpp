#include "problem/balance.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <vector>

#include "settings/field_text.hpp"

namespace kreisel::core {

Balance::Balance(const Vec3& point, const std::optional<Vec3>& direction)
    : point_(point), direction_(direction) {
  std::vector<Vec3> across = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (direction_) {
    direction_->normalize();
    const Eigen::Matrix3d axes = axes_along(*direction_);
    across = {axes.row(0), axes.row(1)};
  }
  const auto rows = static_cast<Eigen::Index>(across.size());
  constraints_.matrix.setZero(rows, 10);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Vec3& e = across[static_cast<std::size_t>(r)];
    constraints_.matrix.row(r).segment<3>(SX) = e.transpose();
    constraints_.matrix(r, S1) = -e.dot(point);
    constraints_.names.emplace_back(direction_ ? "the centre of mass stays {} beside the line"
                                               : "the centre of mass stays {} away from the point");
  }
  constraints_.lower = constraints_.upper = Eigen::VectorXd::Zero(rows);
}

Verdict Balance::verify(const Moments& s, double length_mm) const {
  Vec3 off = centre_of_mass(s) - point_;
  if (direction_) off -= off.dot(*direction_) * *direction_;
  Verdict verdict;
  verdict.ok = off.norm() <= 1e-3;
  verdict.values = {{"offset", off.norm()},
                    {"offset_mm", off.norm() * length_mm},
                    {"mass_share", s[S1]},
                    {"objective", value(s)}};
  verdict.text =
      fmt::format("{}: centre of mass {:.3f} mm ({:.1e} L) off the {}, with {:.1f} % of the material",
                  verdict.ok ? "balances" : "does not balance", off.norm() * length_mm, off.norm(),
                  direction_ ? "line" : "point", 100 * s[S1]);
  return verdict;
}

Fields<LineSettings> line_fields(std::string_view point, std::string_view line) {
  using namespace field_text;
  const auto text = [](const std::optional<Vec3>& v) { return v ? text_of(*v) : std::string(); };
  return {{"point", "x,y,z", point, [](auto& s, auto k, auto v) { s.point = vector(k, v); },
           [text](auto& s) { return text(s.point); }},
          {"line", "x,y,z", line,
           [](auto& s, auto k, auto v) {
             s.line = vector(k, v);
             if (s.line->norm() == 0) refuse(k, v, "a direction x,y,z other than zero");
           },
           [text](auto& s) { return text(s.line); }}};
}

Fields<LineSettings> balance_fields() {
  return line_fields(
      "where the centre of mass is to be, mm in model coordinates",
      "direction of a line through that point, where any place on it will do; default: the point itself");
}

std::unique_ptr<Problem> make_balance(const Settings& settings, const Body& body) {
  const auto [point, line] = settings_as<LineSettings>(settings);
  if (!point)
    throw InputError(
        "balance needs to know where; expected --set problem.point=x,y,z (mm, model coordinates)");
  std::optional<Vec3> direction;
  if (line) direction = body.frame.rotation * *line;
  return std::make_unique<Balance>(body.frame.to_body(*point), direction);
}

}  // namespace kreisel::core
