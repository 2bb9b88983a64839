// json_vector.hpp - three numbers of a report.
#pragma once

#include <nlohmann/json.hpp>

#include "kreisel/moments.hpp"

namespace kreisel::core {

inline Vec3 vector_of(const nlohmann::json& values) {
  const auto at = [&](std::size_t k) { return values.at(k).get<double>(); };
  return {at(0), at(1), at(2)};
}

}  // namespace kreisel::core
