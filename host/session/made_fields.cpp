#include "session/made_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kreisel::core {

std::vector<std::string_view> made_shape(const ProblemEntry& problem) {
  if (problem.made.shape) return *problem.made.shape;
  if (problem.upright) return {"up"};
  return {"axis", "contact"};
}

std::vector<std::string> made_settings(const ProblemEntry& problem) {
  std::vector<std::string> names;
  for (const auto& setting : problem.settings.fields())
    if (std::ranges::find(problem.weights, setting.name) == problem.weights.end())
      names.push_back(fmt::format("problem.{}", setting.name));
  return names;
}

}  // namespace kreisel::core
