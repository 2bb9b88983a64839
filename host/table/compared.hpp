// compared.hpp - which runs a table sets beside each other.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "table/layout.hpp"
#include "table/recorded_run.hpp"

namespace kreisel::core {

/// A text of a run: those with the same share a row of the table, or a column of it divides one by the other;
/// empty: it stands for itself. Told by what was asked for: no record is needed.
using ComparedAs = std::function<std::string(const RecordedRun& run)>;

/// @param layout  of a [table] of the experiment's own; nullptr: the one called `table`
/// @throws InputError  there is none of that name
[[nodiscard]] ComparedAs compared_in(const std::string& table, std::shared_ptr<const Layout> layout);

}  // namespace kreisel::core
