#include "problem/float.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "physics/rest_afloat.hpp"
#include "physics/units.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {

namespace {

/// By how much less than it displaces under water a body may weigh and be at home at any depth.
constexpr double hovers = 1e-6;

}  // namespace

Float::Float(const Draft& draft) : draft_(draft) {
  constraints_.matrix.setZero(3, 10);
  constraints_.matrix(0, S1) = constraints_.matrix(1, SX) = constraints_.matrix(2, SY) = 1;
  const Vec3& cb = draft.water.centre_of_buoyancy;
  constraints_.lower = constraints_.upper =
      Eigen::Vector3d(draft.mass, cb[0] * draft.mass, cb[1] * draft.mass) - draft.load.head<3>();
  const char* beside = "the centre of mass stays {} beside the vertical through the centre of buoyancy";
  constraints_.names = {"the mass stays {} away from that of the displaced water", beside, beside};
  if (!draft.sought) return;
  constexpr double none = std::numeric_limits<double>::infinity();
  constraints_.matrix.conservativeResizeLike(Eigen::MatrixXd::Zero(4, 10));
  constraints_.matrix(3, SZ) = 1;
  constraints_.lower =
      Eigen::Vector4d(constraints_.lower[0], constraints_.lower[1], constraints_.lower[2], -none);
  constraints_.upper = Eigen::Vector4d(constraints_.upper[0], constraints_.upper[1], constraints_.upper[2],
                                       draft.water.metacentre() * draft.mass - draft.load[SZ]);
  constraints_.names.push_back("the centre of mass stays {} above the metacentre");
}

Moments Float::gradient(const Moments&) const { return Moments::Unit(SZ) / draft_.mass; }

LinearConstraints Float::also_asked(const Moments&) const {
  constexpr double spare = 0.01;
  LinearConstraints rows;
  rows.matrix = Moments::Unit(SZ).transpose();
  rows.lower.setConstant(1, -std::numeric_limits<double>::infinity());
  rows.upper.setConstant(1, (draft_.water.metacentre() - spare) * draft_.mass - draft_.load[SZ]);
  rows.names = {"the centre of mass stays {} above the metacentre"};
  return rows;
}

std::string Float::scope(const MassModel& mass) const {
  const double own = draft_.mass - draft_.load[S1];  // without what it carries
  if (!draft_.one_material) {
    const double grams = draft_.solid_grams;
    return fmt::format(
        "at this draft with a part of {:.4g} g; these materials "
        "make {:.4g} to {:.4g} g",
        grams * own, grams * mass.fixed[S1], grams * mass.total(mass.interior)[S1]);
  }
  // Solid, the part weighs 1 in solid masses; hollowed out altogether,
  // mass.fixed. Either scales with density.
  const double shell = mass.fixed[S1];
  return fmt::format(
      "at this draft with a material of {:.3g} to {:.3g} "
      "g/cm^3, at some draft with up to {:.3g} g/cm^3 "
      "(here "
      "{:.3g})",
      draft_.density * own, draft_.density * own / shell, draft_.fluid / shell, draft_.density);
}

Verdict Float::verify(const Moments& part, double length_mm) const {
  const Moments s = part + draft_.load;
  const Vec3 c = centre_of_mass(s);
  const Hydrostatics& water = draft_.water;
  const double excess = s[S1] / draft_.mass - 1;
  const double offset = (c - water.centre_of_buoyancy).head<2>().norm();
  const double gm = water.metacentre() - c[2];
  const bool afloat = std::abs(excess) <= 1e-3, above = offset <= 1e-3, stable = gm > 0;
  // For small angles the righting arm is GM sin(heel): the heel at which it
  // takes up the offset.
  const double heel = stable ? std::atan(offset / gm) * 180 / std::numbers::pi : NAN;

  Verdict verdict;
  verdict.ok = afloat && above && stable;
  verdict.values = {{"excess_mass", excess},
                    {"offset_mm", offset * length_mm},
                    {"metacentric_height_mm", gm * length_mm},
                    {"heel_degrees", heel},
                    {"centre_of_mass_z_mm", c[2] * length_mm},
                    {"draft_mm", water.waterline * length_mm},
                    {"displaced_mm3", water.volume * std::pow(length_mm, 3)},
                    {"centre_of_buoyancy_z_mm", water.centre_of_buoyancy[2] * length_mm},
                    {"waterplane_mm2", water.waterplane_area * length_mm * length_mm},
                    {"dry_mm3", water.dry * std::pow(length_mm, 3)},
                    {"objective", value(part)}};
  std::string boat;
  if (draft_.floods_at) {
    const double degrees = *draft_.floods_at * 180 / std::numbers::pi;
    verdict.values["floods_at_degrees"] = degrees;
    boat = fmt::format("; water comes over its rim at a heel of {:.2f} degrees", degrees);
  }
  const std::string where = fmt::format(
      "mass {:+.3f} % of the displaced water's, centre of mass "
      "{:.3f} mm from the vertical through the "
      "centre of "
      "buoyancy, metacentric height {:.3f} mm",
      100 * excess, offset * length_mm, gm * length_mm);
  const std::string loaded =
      draft_.load[S1] > 0 ? fmt::format("with {:.4g} g on board, ", draft_.load[S1] * draft_.solid_grams)
                          : "";
  if (verdict.ok) {
    verdict.text = fmt::format("floats: {}{}; heels {:.2f} degrees at rest{}", loaded, where, heel, boat);
    return verdict;
  }
  std::vector<std::string_view> reasons;
  if (!afloat) reasons.push_back(excess > 0 ? "too heavy" : "too light");
  if (!above) reasons.push_back("centre of mass beside the centre of buoyancy by more than 1e-3 L");
  if (!stable) reasons.push_back("centre of mass above the metacentre");
  verdict.text = fmt::format("does not float upright ({}): {}", fmt::join(reasons, "; "), where);
  return verdict;
}

Verdict Float::verify_at_rest(const Moments& part, double length_mm) const {
  Verdict verdict = verify(part, length_mm);
  if (!draft_.hull) return verdict;
  const Moments s = part + draft_.load;
  const double volume = s[S1] / draft_.mass * draft_.water.volume;
  const double most = most_displaced(*draft_.hull);
  if (volume > (1 + hovers) * most) verdict.text += "; left to itself it sinks";
  if (volume > (1 - hovers) * most) return verdict;
  const RestAfloat rest = rest_afloat({*draft_.hull, centre_of_mass(s), volume});
  const double axis = draft_.water.least_axis;
  const Vec3 along(std::cos(axis), std::sin(axis), 0), across(-std::sin(axis), std::cos(axis), 0);
  const double heel = degrees(std::atan2(std::abs(rest.up.dot(across)), rest.up[2])),
               trim = degrees(std::atan2(std::abs(rest.up.dot(along)), rest.up[2])),
               tilt = degrees(std::atan2(rest.up.head<2>().norm(), rest.up[2]));
  verdict.values["rest_heel_degrees"] = heel;
  verdict.values["rest_trim_degrees"] = trim;
  verdict.values["rest_tilt_degrees"] = tilt;
  if (rest.floods || rest.sinks)
    verdict.text += fmt::format("; left to itself it leans until water comes over its rim{}",
                                rest.sinks ? ", and sinks" : "");
  if (rest.sinks) return verdict;
  constexpr double upright = 0.1, over = 90;  // degrees
  if (tilt > over)
    verdict.text +=
        fmt::format("; left to itself it turns over, and comes to rest {:.1f} degrees from upright", tilt);
  else if (tilt > upright)
    verdict.text += fmt::format(
        "; left to itself it comes to rest with a heel of {:.2f} and a trim of {:.2f} degrees", heel, trim);
  return verdict;
}

namespace {

DraftSpec draft(std::string_view key, std::string_view text) {
  const auto above_none = [](std::optional<double> v) { return v && *v > 0; };
  if (text == "solid") return {DraftSpec::solid, 0};
  if (text == "auto") return {DraftSpec::open, 0};
  if (const auto share = parse_with_unit(text, "%"); above_none(share) && *share <= 100)
    return {DraftSpec::share, *share};
  if (const auto grams = parse_with_unit(text, "g"); above_none(grams)) return {DraftSpec::mass, *grams};
  if (const auto depth = parse<double>(text.ends_with("mm") ? text.substr(0, text.size() - 2) : text);
      above_none(depth))
    return {DraftSpec::depth, *depth};
  field_text::refuse(key, text,
                     "a share of the height such as 60%, a depth in mm, a mass "
                     "such as 40g, solid or auto");
}

std::string text_of(const DraftSpec& draft) {
  switch (draft.kind) {
    case DraftSpec::share:
      return fmt::format("{}%", draft.value);
    case DraftSpec::mass:
      return fmt::format("{}g", draft.value);
    case DraftSpec::depth:
      return fmt::format("{}mm", draft.value);
    case DraftSpec::solid:
      return "solid";
    case DraftSpec::open:
      break;
  }
  return "auto";
}

std::vector<Load> loads(std::string_view key, std::string_view text) {
  std::vector<Load> all;
  for (const std::string_view one : field_text::split(text, ';')) {
    const std::size_t at = one.find('@');
    const auto grams = at == one.npos ? std::nullopt : parse_with_unit(one.substr(0, at), "g");
    const auto plain = at == one.npos ? std::nullopt : parse<double>(one.substr(0, at));
    const auto where = at == one.npos ? std::nullopt : parse_vector(one.substr(at + 1));
    const double mass = grams ? *grams : plain.value_or(0);
    if (!where || !(mass > 0)) field_text::refuse(key, text, "grams and a place in mm, such as 20@0,0,5");
    all.push_back({mass, *where});
  }
  return all;
}

std::string text_of(const std::vector<Load>& loads) {
  std::string text;
  for (const Load& load : loads)
    text +=
        fmt::format("{}{}@{},{},{}", text.empty() ? "" : ";", load.grams, load.at[0], load.at[1], load.at[2]);
  return text;
}

/// Body frame. @param fluid  g/cm^3  @param load  g
double waterline_for(const DraftSpec& draft, const Body& body, double fluid, double load) {
  const Box box = bounding_box(body.local);
  const double height = box.extent()[2];
  switch (draft.kind) {
    case DraftSpec::share:
      return box.lo[2] + draft.value / 100 * height;
    case DraftSpec::mass:
    case DraftSpec::solid: {
      const double grams = draft.kind == DraftSpec::solid ? body.mass_grams() + load : draft.value;
      const double submerged = fluid / body.density * body.mass_grams();
      // Under water it displaces that much. Whether it is a boat, and can displace more, is then to be seen.
      const double most = grams < (1 - hovers) * submerged
                              ? submerged
                              : most_displaced(body.local) / body.solid[S1] * submerged;
      if (grams < (1 - hovers) * most)
        if (const auto waterline =
                waterline_of(body.local, body.solid[S1] * grams / submerged, body.cavities))
          return *waterline;
      throw InputError(fmt::format(
          "problem.draft = {}: {} {} with {:.4g} g; expected less than the {:.4g} g of fluid that it can "
          "displace",
          text_of(draft), body.name, grams > (1 + hovers) * most ? "sinks" : "hovers under water", grams,
          most));
    }
    case DraftSpec::depth:
      if (draft.value <= height * body.frame.length) return box.lo[2] + draft.value / body.frame.length;
      throw InputError(fmt::format("problem.draft = {}: {} is {:.4g} mm high; expected a depth up to that",
                                   text_of(draft), body.name, height * body.frame.length));
    case DraftSpec::open:
      break;
  }
  throw InputError(
      "problem.draft = auto: a draft that is to be found; "
      "expected one that is known");
}

}  // namespace

Fields<FloatSettings> float_fields() {
  using namespace field_text;
  return {
      {"draft", "",
       "how deep it floats: 60% of the height (default), mm, grams of displaced water (40g), solid, or auto",
       [](auto& s, auto k, auto v) { s.draft = draft(k, v); },
       [](auto& s) { return kreisel::core::text_of(s.draft); }},
      {"fluid_density", "g/cm^3", "density of what it floats in; default 1",
       [](auto& s, auto k, auto v) { s.fluid_density = positive(k, v); },
       [](auto& s) { return number_text(s.fluid_density); }},
      {"load", "g@x,y,z", "a weight that it carries, and where, mm; several with ; between",
       [](auto& s, auto k, auto v) { s.loads = loads(k, v); },
       [](auto& s) { return kreisel::core::text_of(s.loads); }}};
}

Moments moments_of(const std::vector<Load>& loads, const Body& body) {
  Moments all = Moments::Zero();
  for (const Load& load : loads) {
    const double mass = load.grams / body.mass_grams();
    all[S1] += mass;
    all.segment<3>(SX) += mass * body.frame.to_body(load.at);
  }
  return all;
}

std::unique_ptr<Problem> make_float(const Settings& settings, const Body& body) {
  const auto [draft, fluid, loads] = settings_as<FloatSettings>(settings);
  Draft result;
  result.sought = draft.sought;
  result.load = moments_of(loads, body);
  result.water = hydrostatics(
      body.local, waterline_for(draft, body, fluid, result.load[S1] * body.mass_grams()), body.cavities);
  result.fluid = fluid;
  result.density = body.density;
  result.one_material = body.one_material() && body.void_density == 0;
  result.solid_grams = body.mass_grams();
  // A body unit of volume is the solid's own, and so is a unit of mass.
  result.mass = fluid / body.density * result.water.volume;
  constexpr double boat = 0.01;  // of the displaced: hardly what the folds of a scan hold
  if (result.water.dry > boat * result.water.volume)
    result.floods_at = flooding_heel(body.local, result.water.volume, result.water.least_axis);
  result.hull = std::make_shared<const TriangleMesh>(body.local);
  return std::make_unique<Float>(result);
}

std::vector<Settings> drafts_of(const Settings& settings, const Body&) {
  auto each = settings_as<FloatSettings>(settings);
  if (each.draft.kind != DraftSpec::open) return {settings};
  std::vector<Settings> all;
  // Shares of the height: what displaces nothing like what the body can weigh
  // is infeasible at once.
  for (const double percent : {25, 40, 50, 60, 70, 85}) {
    each.draft = {DraftSpec::share, percent, true};
    all.emplace_back(each);
  }
  return all;
}

}  // namespace kreisel::core
