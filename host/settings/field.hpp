// field.hpp - a field of a kind of run, described once: what command lines, TOML, records and docs make of
// it.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "unknown_name.hpp"

namespace kreisel::core {

/// Whether a field belongs to the identity of a run: what its record is called after, and what it says.
enum class Identity {
  always,   ///< even at its default
  changed,  ///< where it is not at its default
  none      ///< no: how often, how long, where
};

/// The words that a value may be, or may begin with.
using Choices = std::function<std::vector<std::string>()>;

/// One field of a T, a run or a part of one.
template <class T>
struct Field {
  std::string_view name;  ///< as TOML and records call it; an option is "--" and this (option_of())
  std::string_view unit;  ///< of its value, or what that looks like; empty: text, or a number without unit
  std::string_view help;
  /// Takes a value from text. @throws InputError  a value that does not fit, with what was expected
  std::function<void(T& run, std::string_view name, std::string_view value)> set;
  /// The value as set() takes it; empty: there is none.
  std::function<std::string(const T& run)> text;
  Identity identity = Identity::changed;
  int words = 1;                ///< that its value consists of (words.hpp); 0: any number of them
  bool shapes = false;          ///< its words name shapes: models, or mesh files that are read
  std::string_view group = "";  ///< under which help lists it
  Choices choices = {};         ///< empty: any value that set() takes
  std::string_view alone = "";  ///< the value where its option has none; empty: there must be one
};

template <class T>
using Fields = std::vector<Field<T>>;

/// The name of its option: a setting's without the group, with - for _.
template <class T>
[[nodiscard]] std::string option_of(const Field<T>& field) {
  std::string name(field.name.substr(field.name.find('.') + 1));
  std::ranges::replace(name, '_', '-');
  return name;
}

template <class T>
[[nodiscard]] Fields<T> grouped(std::string_view group, Fields<T> fields) {
  for (Field<T>& field : fields) field.group = group;
  return fields;
}

/// The names of entries, as they are when they are asked for: a registry may be added to.
template <class Get>
[[nodiscard]] Choices names_in(Get entries) {
  return [entries] {
    const auto names = names_of(entries());
    return std::vector<std::string>(names.begin(), names.end());
  };
}

/// The field with what its value may be.
template <class T>
[[nodiscard]] Field<T> chosen_from(Choices choices, Field<T> field) {
  field.choices = std::move(choices);
  return field;
}

/// Tables of fields as one; those of a base of T among them.
template <class T, class... Parts>
[[nodiscard]] Fields<T> joined(const Fields<Parts>&... parts) {
  Fields<T> all;
  const auto add = [&](const auto& fields) {
    for (const auto& f : fields)
      all.push_back({f.name, f.unit, f.help, f.set, f.text, f.identity, f.words, f.shapes, f.group, f.choices,
                     f.alone});
  };
  (add(parts), ...);
  return all;
}

/// The fields of a part as those of the whole. @param get  the part of a whole, const or not
template <class Whole, class Part, class Get>
[[nodiscard]] Fields<Whole> fields_of_part(const Fields<Part>& fields, Get get) {
  Fields<Whole> all;
  for (const Field<Part>& f : fields)
    all.push_back({f.name, f.unit, f.help,
                   [get, set = f.set](Whole& whole, std::string_view name, std::string_view value) {
                     set(get(whole), name, value);
                   },
                   [get, text = f.text](const Whole& whole) { return text(get(whole)); }, f.identity, f.words,
                   f.shapes, f.group, f.choices, f.alone});
  return all;
}

/// The field of that name; nullptr: there is none.
template <class T>
[[nodiscard]] const Field<T>* find_field(const Fields<T>& fields, std::string_view name) {
  const auto found = std::ranges::find(fields, name, &Field<T>::name);
  return found == fields.end() ? nullptr : &*found;
}

/// "centroid: a nesting of layers has no such field; expected a kind that has it: scale, test".
template <class Names>
[[nodiscard]] InputError not_a_field_of(std::string_view what, std::string_view name, const Names& kinds) {
  return InputError(fmt::format("{}: {} has no such field; expected a kind that has it: {}", name, what,
                                fmt::join(kinds, ", ")));
}

/// @throws InputError  unknown name, says the nearest; or a value that does not fit
template <class T>
void set_field(const Fields<T>& fields, T& run, std::string_view name, std::string_view value) {
  const Field<T>* field = find_field(fields, name);
  if (!field) throw unknown_name("field", name, names_of(fields));
  field->set(run, name, value);
}

/// Every field that belongs to the identity of a run, by name, sorted. @param defaults  a run as it begins
template <class T>
[[nodiscard]] std::map<std::string, std::string> describe(const Fields<T>& fields, const T& run,
                                                          const T& defaults) {
  std::map<std::string, std::string> said;
  for (const Field<T>& field : fields) {
    if (field.identity == Identity::none) continue;
    std::string text = field.text(run);
    if (field.identity == Identity::always || text != field.text(defaults))
      said.emplace(field.name, std::move(text));
  }
  return said;
}

}  // namespace kreisel::core
