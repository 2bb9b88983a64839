#include "settings/settings.hpp"

#include "nearest.hpp"

namespace kreisel::core {
namespace {

InputError unknown_setting(const Fields<Settings>& fields, std::string_view group, std::string_view owner,
                           std::string_view name, std::string_view text) {
  constexpr std::size_t few = 20;  // that a line can list
  const auto names = names_of(fields);
  const std::string meant = nearest(name, names);
  const std::string expected = names.empty()         ? "none: it takes no settings"
                               : names.size() <= few ? fmt::format("one of: {}", fmt::join(names, ", "))
                                                     : fmt::format("one of its {} settings", names.size());
  return InputError(fmt::format("{}.{} = {}; {} has no setting of that name{}; expected {}", group, name,
                                text, owner, meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant),
                                expected));
}

}  // namespace

SettingTable SettingTable::open() {
  SettingTable table;
  table.usual_ = SettingTexts();
  table.open_ = true;
  return table;
}

Settings SettingTable::read(const SettingTexts& given, std::string_view group, std::string_view owner) const {
  if (open_) return given;
  Settings settings = usual_;
  for (const auto& [name, text] : given) {
    const Field<Settings>* field = find_field(fields_, name);
    if (!field) throw unknown_setting(fields_, group, owner, name, text);
    field->set(settings, fmt::format("{}.{}", group, name), text);
  }
  return settings;
}

SettingTexts SettingTable::in_force(const Settings& settings) const {
  if (open_) return settings_as<SettingTexts>(settings);
  SettingTexts texts;
  for (const Field<Settings>& field : fields_)
    if (std::string text = field.text(settings); !text.empty()) texts.emplace(field.name, std::move(text));
  return texts;
}

SettingTexts SettingTable::changed(const Settings& settings) const {
  return open_ ? settings_as<SettingTexts>(settings) : describe(fields_, settings, usual_);
}

}  // namespace kreisel::core
