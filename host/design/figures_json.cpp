#include "design/figures_json.hpp"

#include "json_list.hpp"

namespace kreisel::core {

nlohmann::json json_of(const Figures& f) {
  nlohmann::json quality = nlohmann::json::object();
  for (const auto& [name, value] : f.verdict.values) quality[name] = json_number(value);
  return {{"mass_g", f.mass},
          {"volume_mm3", f.volume},
          {"centre_of_mass_mm", json_list(f.centre_of_mass)},
          {"inertia_g_mm2", json_rows(f.inertia)},
          {"principal_moments_g_mm2", json_list(f.principal)},
          {"principal_axes", json_rows(f.axes.transpose())},
          {"ok", f.verdict.ok},
          {"text", f.verdict.text},
          {"quality", quality}};
}

}  // namespace kreisel::core
