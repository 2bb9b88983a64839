#include "problem/top.hpp"

#include <fmt/format.h>

#include <cmath>

#include "settings/field_text.hpp"

namespace kreisel::core {
namespace {

SpinWeights weights_of(const TopOptions& o) {
  return {.height = o.lower == Lower::height ? o.gamma_c : 0,
          .moment = o.lower == Lower::mass ? o.gamma_c : 0,
          .gamma_i = o.gamma_i};
}

}  // namespace

Top::Top(const TopOptions& options, const std::optional<Moments>& solid)
    : Spinning(weights_of(options), false, options.form), solid_(solid) {}

Verdict Top::verify(const Moments& s, double length_mm) const {
  Verdict verdict = Spinning::verify(s, length_mm);
  if (!solid_) return verdict;
  const double mine = verdict.values.at("omega_min_rpm"), solid = omega_min_rpm(*solid_, length_mm);
  verdict.values["omega_min_solid_rpm"] = solid;
  verdict.values["omega_reduction"] = solid / mine;
  if (!verdict.ok || !std::isfinite(mine)) return verdict;
  if (std::isfinite(solid))
    verdict.text += fmt::format(", {:.2f} times slower than the solid's {:.0f}", solid / mine, solid);
  else if (centre_of_mass(*solid_)[2] > 0)
    verdict.text += ", the solid at no speed: its moment about the axis is not the largest";
  return verdict;
}

Fields<TopOptions> top_fields() {
  using namespace field_text;
  return {one_of<TopOptions>(
              "lower", "what is lowered beside the inertia ratio: mass (default), height or none",
              {"mass", "height", "none"}, [](auto& o) -> auto& { return o.lower; }),
          {"gamma_c", "", "weight of what is lowered; default 1",
           [](auto& o, auto k, auto v) { o.gamma_c = not_negative(k, v); },
           [](auto& o) { return number_text(o.gamma_c); }},
          inertia_weight_field<TopOptions>(),
          form_field<TopOptions>()};
}

std::unique_ptr<Problem> make_top(const Settings& settings, const Body& body) {
  return std::make_unique<Top>(settings_as<TopOptions>(settings), body.solid);
}

}  // namespace kreisel::core
