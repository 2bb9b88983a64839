// field_names.hpp - what set_field() takes.
#pragma once

#include <string_view>
#include <vector>

namespace kreisel::core {

/// Every field by name, and "GROUP.NAME" for each group of settings.
[[nodiscard]] std::vector<std::string_view> field_names();

/// Whether set_field() takes the key; of a setting it knows the group alone.
[[nodiscard]] bool is_field(std::string_view key);

}  // namespace kreisel::core
