#include "problem/top.hpp"

#include <fmt/format.h>

#include <cmath>

#include "error.hpp"
#include "parse.hpp"

namespace kreisel::core {
namespace {

SpinWeights weights_of(const TopOptions& o) {
  return {.height = o.lower == Lower::height ? o.gamma_c : 0,
          .moment = o.lower == Lower::mass ? o.gamma_c : 0,
          .gamma_i = o.gamma_i};
}

std::optional<Lower> lower_of(const std::string& text) {
  if (text == "mass") return Lower::mass;
  if (text == "height") return Lower::height;
  if (text == "none") return Lower::none;
  return std::nullopt;
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

std::unique_ptr<Problem> make_top(const ProblemSettings& settings, const Body& body) {
  TopOptions options;
  for (const auto& [name, text] : settings) {
    const double value = parse<double>(text).value_or(-1);
    const auto lower = lower_of(text);
    if (name == "lower" && lower)
      options.lower = *lower;
    else if (name == "form" && (text == "trace" || text == "angle"))
      options.form = text == "angle" ? SpinForm::angle : SpinForm::trace;
    else if (name == "gamma_c" && value >= 0 && std::isfinite(value))
      options.gamma_c = value;
    else if (name == "gamma_i" && value > 0 && std::isfinite(value))
      options.gamma_i = value;
    else
      throw InputError(
          fmt::format("problem.{} = {} for top; expected lower = mass, height or none, gamma_c >= 0, "
                      "gamma_i > 0, or form = trace or angle",
                      name, text));
  }
  return std::make_unique<Top>(options, body.solid);
}

}  // namespace kreisel::core
