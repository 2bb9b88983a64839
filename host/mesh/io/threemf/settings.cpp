#include "mesh/io/threemf/settings.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "error.hpp"
#include "mesh/io/text.hpp"
#include "mesh/io/threemf/xml.hpp"
#include "parse.hpp"

namespace kreisel::core::threemf {
namespace {

/// As PrusaSlicer and BambuStudio write it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kinds{
    {{"modelpart", ""},
     {"normal_part", ""},
     {"negativevolume", "negative volume"},
     {"negative_part", "negative volume"},
     {"parametermodifier", "modifier"},
     {"modifier_part", "modifier"},
     {"supportenforcer", "support enforcer"},
     {"support_enforcer", "support enforcer"},
     {"supportblocker", "support blocker"},
     {"support_blocker", "support blocker"}}};

class SettingsVisitor final : public XmlVisitor {
 public:
  SettingsVisitor(SlicerSettings& settings, std::string name) : settings_(settings), name_(std::move(name)) {}

  void start(const Element& e) override {
    ++depth_;
    if (e.name == "object") {
      object_ = e.get("id").value_or("");
    } else if (e.name == "volume") {
      volume_ = {number(e, "firstid"), number(e, "lastid"), ""};
      volume_depth_ = depth_;
    } else if (e.name == "metadata" && volume_depth_) {
      const auto key = e.get("key"), value = e.get("value");
      if (key == "volume_type")
        volume_.role = role(value.value_or(""));
      else if (key == "modifier" && value == "1" && volume_.role.empty())
        volume_.role = "modifier";  // before there were other kinds
    } else if (e.name == "part") {
      const auto kind = e.get("subtype");
      const Role of_part = kind ? role(*kind) : Role{};
      if (!of_part.empty()) settings_.components[object_][std::string(e.get("id").value_or(""))] = of_part;
    }
  }

  void end() override {
    if (volume_depth_ == depth_) {
      if (!volume_.role.empty()) settings_.ranges[object_].push_back(volume_);
      volume_depth_ = 0;
    }
    --depth_;
  }

 private:
  [[nodiscard]] Role role(std::string_view kind) const {
    const std::string lower = lower_case(kind);
    for (const auto& [name, words] : kinds)
      if (name == lower) return Role(words);
    throw InputError(
        fmt::format("{}: line {}: a volume of the kind '{}', expected a part, modifier, support "
                    "enforcer or blocker, or negative volume",
                    name_, line, shown(kind)));
  }
  [[nodiscard]] std::size_t number(const Element& e, std::string_view attribute) const {
    const std::string_view word = e.get(attribute).value_or("");
    const auto value = parse<std::size_t>(word);
    if (!value)
      throw InputError(fmt::format("{}: line {}: {} = '{}' of a volume, expected a whole number", name_, line,
                                   attribute, shown(word)));
    return *value;
  }

  SlicerSettings& settings_;
  std::string name_, object_;
  RoleRange volume_{};
  std::size_t depth_ = 0, volume_depth_ = 0;  ///< the latter 0 outside of a volume
};

}  // namespace

Role SlicerSettings::of_component(const std::string& object, const std::string& part) const {
  const auto parts = components.find(object);
  if (parts == components.end()) return {};
  const auto found = parts->second.find(part);
  return found == parts->second.end() ? Role{} : found->second;
}

SlicerSettings slicer_settings(const Package& package, const std::string& file) {
  SlicerSettings settings;
  for (const auto& [name, text] : package) {
    if (!name.starts_with("metadata/")) continue;
    if (!name.ends_with("model.config") && !name.ends_with("model_settings.config")) continue;
    const std::string place = fmt::format("{}: {}", file, name);
    SettingsVisitor visitor(settings, place);
    walk_xml(text, place, visitor);
  }
  return settings;
}

Role cura_role(std::string_view key, std::string_view value) {
  const std::string on = lower_case(value);
  if (on != "true" && on != "1") return {};
  if (key == "support_mesh") return "support mesh";
  if (key == "infill_mesh") return "infill mesh";
  if (key == "cutting_mesh") return "cutting mesh";
  if (key == "anti_overhang_mesh") return "support blocker";
  return {};
}

}  // namespace kreisel::core::threemf
