#include "mesh/io/length_unit.hpp"

#include <algorithm>

#include "unknown_name.hpp"

namespace kreisel::core {

const std::vector<LengthUnit>& length_units() {
  static const std::vector<LengthUnit> all = {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}};
  return all;
}

const LengthUnit& find_length_unit(std::string_view name) {
  const auto unit = std::ranges::find(length_units(), name, &LengthUnit::name);
  if (unit == length_units().end()) throw unknown_name("unit", name, names_of(length_units()));
  return *unit;
}

}  // namespace kreisel::core
