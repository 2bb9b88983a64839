// settings.hpp - what problems, formulations and solvers can be told: described by each of them once, as
// fields of a type of its own. Everybody else has settings as text, or as a value that only their owner looks
// into.
#pragma once

#include <any>
#include <map>
#include <string>
#include <string_view>

#include "settings/field.hpp"

namespace kreisel::core {

/// As they are written, without their group: name -> text. So command lines, TOML, records and the library
/// have them.
using SettingTexts = std::map<std::string, std::string>;

/// As their owner has read them.
using Settings = std::any;

/// The settings of one owner: their fields, whose names have no group, over a type T.
class SettingTable {
 public:
  /// Of an owner that takes none.
  SettingTable() = default;
  /// A T as it begins has the defaults.
  template <class T>
  SettingTable(const Fields<T>& fields)
      : usual_(T()),
        fields_(fields_of_part<Settings>(
            fields, [](auto& all) -> auto& { return *std::any_cast<T>(&all); })) {}
  /// Of an owner that reads texts itself, whatever their names: its type is SettingTexts.
  [[nodiscard]] static SettingTable open();

  [[nodiscard]] const Fields<Settings>& fields() const { return fields_; }

  /// @param owner  who takes them, and their group: for messages
  /// @throws InputError  an unknown setting, or a value that does not fit
  [[nodiscard]] Settings read(const SettingTexts& given, std::string_view group,
                              std::string_view owner) const;
  /// All that have a value, defaults included.
  [[nodiscard]] SettingTexts in_force(const Settings& settings) const;
  /// Those that are not at their defaults.
  [[nodiscard]] SettingTexts changed(const Settings& settings) const;

 private:
  Settings usual_;
  Fields<Settings> fields_;
  bool open_ = false;
};

/// What its owner has read; of nobody's, the defaults.
template <class T>
[[nodiscard]] T settings_as(const Settings& settings) {
  return settings.has_value() ? std::any_cast<const T&>(settings) : T();
}

}  // namespace kreisel::core
