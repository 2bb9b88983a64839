// made_fields.hpp - which fields of a question count for somebody who makes a thing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "problem/problem.hpp"

namespace kreisel::core {

/// How the body lies and is shaped, as far as that matters to the problem.
[[nodiscard]] std::vector<std::string_view> made_shape(const ProblemEntry& problem);

/// The problem's settings, but for those that weigh the terms of f: "problem.draft".
[[nodiscard]] std::vector<std::string> made_settings(const ProblemEntry& problem);

}  // namespace kreisel::core
