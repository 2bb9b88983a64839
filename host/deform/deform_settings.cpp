#include "deform/deform_settings.hpp"

#include <fmt/format.h>

#include "settings/field_text.hpp"

namespace kreisel::core {
namespace {

constexpr int finest = 6;  ///< weights on finer grids take minutes

Field<DeformSettings> level_field(std::string_view name, std::string_view help, int DeformSettings::*level) {
  using namespace field_text;
  return {name, "", help,
          [level](auto& s, auto k, auto v) {
            s.*level = whole(k, v, 1);
            if (s.*level > finest) refuse(k, v, fmt::format("1 to {}", finest));
          },
          [level](auto& s) { return std::to_string(s.*level); }};
}

Fields<DeformSettings> fields() {
  using namespace field_text;
  return {one_of<DeformSettings>(
              "handles",
              "lattice (of a B-spline, default) or cage (corners of the octree cells that "
              "meet the body)",
              {"lattice", "cage"}, [](auto& s) -> auto& { return s.handles; }),
          level_field("level", "of the cage's cells, 2^level along the longest side; default 2",
                      &DeformSettings::level),
          level_field("grid", "level of the cells that a cage's weights are solved for on; default 4",
                      &DeformSettings::grid),
          {"gamma_dl", "", "weight of how much the surface bends, with voxel or octree; default 1",
           [](auto& s, auto k, auto v) { s.gamma_dl = not_negative(k, v); },
           [](auto& s) { return number_text(s.gamma_dl); }},
          {"gamma_dv", "", "of how far it moves, body units squared; default 100",
           [](auto& s, auto k, auto v) { s.gamma_dv = positive(k, v); },
           [](auto& s) { return number_text(s.gamma_dv); }}};
}

}  // namespace

const SettingTable& deform_settings() {
  static const SettingTable all(fields());
  return all;
}

DeformSettings parse_deform_settings(const SettingTexts& given) {
  const auto settings = settings_as<DeformSettings>(deform_settings().read(given, "deform", "--deform"));
  if (settings.grid < settings.level)
    field_text::refuse("deform.grid", std::to_string(settings.grid),
                       fmt::format("at least the level of the cage, {}", settings.level));
  return settings;
}

}  // namespace kreisel::core
