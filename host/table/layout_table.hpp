// layout_table.hpp - runs set out by a layout.
#pragma once

#include <optional>
#include <vector>

#include "table/layout.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// @throws InputError  an expression of the layout that cannot be read
[[nodiscard]] Tables tables_of(const Layout& layout, const std::vector<RecordedRun>& runs,
                               const std::optional<Published>& published);

}  // namespace kreisel::core
