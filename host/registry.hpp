// registry.hpp - what is known by name: problems, formulations, solvers; in their order, and more may be
// added.
#pragma once

#include <algorithm>
#include <deque>
#include <string_view>
#include <utility>
#include <vector>

#include "unknown_name.hpp"

namespace kreisel::core {

/// Entries have a `name`. References to them stay valid. Whoever adds does so before others look.
template <class Entry>
class Registry {
 public:
  /// @param kind  what is named, for messages: problem, formulation, ...
  Registry(std::string_view kind, const std::vector<Entry>& entries)
      : kind_(kind), entries_(entries.begin(), entries.end()) {}

  [[nodiscard]] auto begin() const { return entries_.begin(); }
  [[nodiscard]] auto end() const { return entries_.end(); }

  /// @throws InputError  unknown: says the nearest, and which there are
  [[nodiscard]] const Entry& find(std::string_view name) const {
    const auto entry = std::ranges::find(entries_, name, &Entry::name);
    if (entry == entries_.end()) throw unknown_name(kind_, name, names_of(entries_));
    return *entry;
  }

  /// @throws InputError  no name, or one that is taken
  void add(Entry entry) {
    if (entry.name.empty()) throw InputError(fmt::format("a {} without a name; expected one", kind_));
    if (std::ranges::find(entries_, entry.name, &Entry::name) != entries_.end())
      throw InputError(fmt::format("{} '{}' is there already; expected another name", kind_, entry.name));
    entries_.push_back(std::move(entry));
  }

 private:
  std::string_view kind_;
  std::deque<Entry> entries_;
};

}  // namespace kreisel::core
