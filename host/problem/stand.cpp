#include "problem/stand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// For every edge of the base a row with an upper bound of 0: `extra` beside n . (sx, sy) - d s1.
/// @param stays  where the centre of mass does, of an edge
LinearConstraints edge_rows(const Base& base, std::string_view stays, const Moments& extra) {
  const auto rows = static_cast<Eigen::Index>(base.polygon.edges.size());
  LinearConstraints c;
  c.matrix = extra.transpose().replicate(rows, 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const SupportPolygon::Edge& e = base.polygon.edges[static_cast<std::size_t>(i)];
    c.matrix(i, SX) += e.n[0];
    c.matrix(i, SY) += e.n[1];
    c.matrix(i, S1) -= e.d;
    c.names.push_back(fmt::format("the centre of mass stays {{}} {} edge {} of the base", stays, i));
  }
  c.lower.setConstant(rows, -infinity);
  c.upper.setZero(rows);
  return c;
}

/// Of c_z.
Moments height_gradient(const Moments& s) {
  Moments g = Moments::Zero();
  g[SZ] = 1 / s[S1];
  g[S1] = -s[SZ] / (s[S1] * s[S1]);
  return g;
}

Matrix10 height_hessian(const Moments& s) {
  Matrix10 h = Matrix10::Zero();
  const double m = s[S1];
  h(S1, SZ) = h(SZ, S1) = -1 / (m * m);
  h(S1, S1) = 2 * s[SZ] / (m * m * m);
  return h;
}

Verdict verdict_of(const Base& base, const Moments& s, double length_mm, double objective) {
  const Vec3 c = centre_of_mass(s);
  const double inside = base.polygon.inside(c.head<2>());
  const double tilt = std::atan(base.tangent(c)) * 180 / std::numbers::pi;
  Verdict verdict;
  verdict.ok = inside > 0;
  verdict.values = {{"inside_mm", inside * length_mm},
                    {"off_centroid_mm", (c.head<2>() - base.polygon.centroid).norm() * length_mm},
                    {"tilt_degrees", tilt},
                    {"centre_of_mass_z_mm", (c[2] - base.ground) * length_mm},
                    {"height_share", (c[2] - base.ground) / base.height},
                    {"base_area_mm2", base.polygon.area * length_mm * length_mm},
                    {"objective", objective}};
  const std::string how = fmt::format(
      "centre of mass {:.3f} mm {} the base, at {:.1f} % of the height", std::abs(inside) * length_mm,
      verdict.ok ? "inside the edge of" : "outside", 100 * (c[2] - base.ground) / base.height);
  verdict.text = verdict.ok ? fmt::format("stands: {}; topples at a tilt of {:.2f} degrees", how, tilt)
                            : fmt::format("does not stand: {}", how);
  return verdict;
}

}  // namespace

Stand::Stand(Base base, std::optional<double> margin) : base_(std::move(base)), margin_(margin) {
  LinearConstraints& c = constraints_;
  if (!margin) {
    c.matrix.setZero(2, 10);
    c.matrix(0, SX) = c.matrix(1, SY) = 1;
    c.matrix(0, S1) = -base_.polygon.centroid[0];
    c.matrix(1, S1) = -base_.polygon.centroid[1];
    c.lower = c.upper = Eigen::Vector2d::Zero();
    c.names.assign(2, "the centre of mass stays {} beside the vertical through the middle of the base");
    return;
  }
  allowed_ = shrunk(base_.polygon, *margin);
  c = edge_rows(base_, *margin > 0 ? "too near to, or beyond," : "beyond", *margin * Moments::Unit(S1));
}

Moments Stand::gradient(const Moments& s) const { return height_gradient(s); }

Matrix10 Stand::hessian(const Moments& s) const { return height_hessian(s); }

Moments Baseless::gradient(const Moments& s) const { return height_gradient(s); }

Matrix10 Baseless::hessian(const Moments& s) const { return height_hessian(s); }

std::string Baseless::impossible() const {
  return fmt::format(
      "{} has no base to stand on as it lies: it does not rest on a facet of its convex hull within {} "
      "degrees and "
      "{} mm",
      body_, ground_degrees, ground_play);
}

Verdict Baseless::verify(const Moments& s, double) const {
  return {false, "does not stand: " + impossible(), {{"objective", value(s)}}};
}

std::optional<Ratio> Stand::ratio() const { return Ratio{Moments::Unit(SZ).transpose(), Moments::Unit(S1)}; }

Verdict Stand::verify(const Moments& s, double length_mm) const {
  return verdict_of(base_, s, length_mm, value(s));
}

MaxTilt::MaxTilt(Base base, double tau)
    : base_(std::move(base)),
      tau_(tau),
      constraints_(edge_rows(base_, "too far out to be tilted further over", tau * height_form())) {}

const SupportPolygon::Edge& MaxTilt::nearest(const Moments& s) const {
  const Vec3 c = centre_of_mass(s);
  return *std::ranges::min_element(base_.polygon.edges, {},
                                   [&](const SupportPolygon::Edge& e) { return e.d - e.n.dot(c.head<2>()); });
}

Moments MaxTilt::height_form() const { return Moments::Unit(SZ) - base_.ground * Moments::Unit(S1); }

double MaxTilt::value(const Moments& s) const { return -base_.tangent(centre_of_mass(s)); }

Moments MaxTilt::gradient(const Moments& s) const {
  // f = (n . s_xy - d s1) / h,  h = sz - ground s1
  const SupportPolygon::Edge& e = nearest(s);
  Moments g = Moments::Zero();
  g[SX] = e.n[0];
  g[SY] = e.n[1];
  g[S1] = -e.d;
  return (g - value(s) * height_form()) / height_form().dot(s);
}

Matrix10 MaxTilt::hessian(const Moments& s) const {
  const Moments g = gradient(s), h = height_form();
  return -(g * h.transpose() + h * g.transpose()) / h.dot(s);
}

std::optional<Ratio> MaxTilt::ratio() const {
  Ratio ratio{decltype(Ratio::numerators)::Zero(static_cast<Eigen::Index>(base_.polygon.edges.size()), 10),
              height_form(), false};
  for (Eigen::Index i = 0; i < ratio.numerators.rows(); ++i) {
    const SupportPolygon::Edge& e = base_.polygon.edges[static_cast<std::size_t>(i)];
    ratio.numerators(i, SX) = e.n[0];
    ratio.numerators(i, SY) = e.n[1];
    ratio.numerators(i, S1) = -e.d;
  }
  return ratio;
}

std::unique_ptr<Problem> MaxTilt::next(const Moments& s) const {
  const double reached = -value(s);
  // Superlinear: a step that gains a millionth is followed by one that gains nothing.
  if (reached <= tau_ + 1e-6 * (1 + std::abs(tau_))) return nullptr;
  return std::make_unique<MaxTilt>(base_, reached);
}

Verdict MaxTilt::verify(const Moments& s, double length_mm) const {
  return verdict_of(base_, s, length_mm, value(s));
}

namespace {

const std::vector<std::string_view> targets = {"centre", "inside", "max-tilt"};

}  // namespace

Fields<StandSettings> stand_fields() {
  using namespace field_text;
  return {one_of<StandSettings>(
              "target",
              "where the centre of mass goes: centre (over the middle of the base), inside (over the base, "
              "low) or max-tilt (hardest to topple); default centre, of design max-tilt",
              targets, [](auto& s) -> auto& { return s.target; }),
          {"margin", "mm",
           "least distance from the edge of the base, with target inside; default 1 % of the body's length",
           [](auto& s, auto k, auto v) {
             s.margin_mm = number_where(k, v, "millimetres >= 0", [](double mm) { return mm >= 0; });
           },
           [](auto& s) { return number_text(s.margin_mm); }},
          {"base", "%", "corners up to this share of the height touch the ground; default: what it rests on",
           [](auto& s, auto k, auto v) {
             s.base_percent = parse_with_unit(v, "%").value_or(-1);
             if (!(*s.base_percent >= 0 && *s.base_percent < 100))
               refuse(k, v, "a share of the height such as 0.1%");
           },
           [](auto& s) { return s.base_percent ? fmt::format("{}%", *s.base_percent) : std::string(); }}};
}

std::unique_ptr<Problem> make_stand(const Settings& settings, const Body& body) {
  const auto& [target, margin_mm, tolerance] = settings_as<StandSettings>(settings);
  if (margin_mm && target != StandTarget::inside)
    throw InputError(fmt::format("problem.margin = {} for target {}; expected target = inside", *margin_mm,
                                 targets[static_cast<std::size_t>(target)]));
  const Box box = bounding_box(body.local);
  Base base{tolerance ? support_polygon(body, *tolerance / 100) : resting_polygon(body), box.lo[2],
            box.extent()[2]};
  if (base.polygon.corners.empty()) return std::make_unique<Baseless>(body.name);
  if (target == StandTarget::max_tilt) {
    // From the solid's own tilt, where its density can be had inside; a solid that falls over starts at none,
    // where its problem is still convex.
    const auto [light, heavy] = std::minmax(body.interior_density, body.void_density);
    const bool attainable = light <= body.density && body.density <= heavy;
    const double tau = attainable ? std::max(0.0, base.tangent(centre_of_mass(body.solid))) : 0.0;
    return std::make_unique<MaxTilt>(std::move(base), tau);
  }
  if (target == StandTarget::centre) return std::make_unique<Stand>(std::move(base), std::nullopt);
  const double most = base.polygon.inside(base.polygon.centroid);
  const double margin = margin_mm ? *margin_mm / body.frame.length : std::min(0.01, most / 2);
  if (margin >= most && margin_mm)
    throw InputError(
        fmt::format("problem.margin = {} mm; expected less than the {:.3g} mm from the centroid of the base "
                    "to its edge",
                    *margin_mm, most * body.frame.length));
  return std::make_unique<Stand>(std::move(base), margin);
}

}  // namespace kreisel::core
