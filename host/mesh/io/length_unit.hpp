// length_unit.hpp - what the numbers of a mesh file may mean.
#pragma once

#include <string_view>
#include <vector>

namespace kreisel::core {

struct LengthUnit {
  std::string_view name;  ///< as users write it
  double millimetres;

  bool operator==(const LengthUnit&) const = default;
};

/// Every unit that a user may name: mm, cm, m, in.
[[nodiscard]] const std::vector<LengthUnit>& length_units();

/// @throws InputError  none of that name; says the nearest and names them all
[[nodiscard]] const LengthUnit& find_length_unit(std::string_view name);

}  // namespace kreisel::core
