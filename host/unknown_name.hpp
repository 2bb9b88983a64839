// unknown_name.hpp - the one line for a name that nobody knows.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "error.hpp"
#include "nearest.hpp"

namespace kreisel::core {

/// "problem 'flaot' is unknown (did you mean 'float'?); expected one of: spin, stand, float".
/// @param kind   what is named: problem, formulation, ...
/// @param names  a range of strings
template <class Names>
[[nodiscard]] InputError unknown_name(std::string_view kind, std::string_view name, const Names& names) {
  const std::string meant = nearest(name, names);
  return InputError(fmt::format("{} '{}' is unknown{}; expected one of: {}", kind, name,
                                meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant),
                                fmt::join(names, ", ")));
}

/// The names of a registry's entries.
template <class Entries>
[[nodiscard]] std::vector<std::string_view> names_of(const Entries& entries) {
  std::vector<std::string_view> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

}  // namespace kreisel::core
