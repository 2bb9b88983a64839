#include "problem/spin.hpp"

#include "settings/field_text.hpp"

namespace kreisel::core {

Fields<SpinOptions> spin_fields() {
  using namespace field_text;
  return {{"lambda", "", "weight of the height of the centre of mass; default 0",
           [](auto& o, auto k, auto v) { o.lambda = not_negative(k, v); },
           [](auto& o) { return number_text(o.lambda); }},
          inertia_weight_field<SpinOptions>()};
}

std::unique_ptr<Problem> make_spin(const Settings& settings, const Body&) {
  return std::make_unique<Spin>(settings_as<SpinOptions>(settings));
}

}  // namespace kreisel::core
