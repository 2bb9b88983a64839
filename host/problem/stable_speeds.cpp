#include "problem/stable_speeds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "physics/spin_check.hpp"

namespace kreisel::core {

void add_stable_speeds(Verdict& verdict, const Moments& s, double length_mm) {
  const auto above = [&](Contact contact) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return stable_above(stable_rpm(s, length_mm, contact)).value_or(none);
  };
  const double gliding = above(Contact::gliding), held = above(Contact::held);
  verdict.values["gliding_stable_above_rpm"] = gliding;
  verdict.values["held_stable_above_rpm"] = held;
  if (!verdict.ok) return;
  const auto text = [](double rpm) {
    return std::isnan(rpm) ? std::string("not at high speeds")
           : rpm == 0      ? std::string("at any speed")
                           : fmt::format("above {:.0f} rpm", rpm);
  };
  verdict.text += fmt::format(" (spectrum: gliding {}, held {})", text(gliding), text(held));
}

}  // namespace kreisel::core
