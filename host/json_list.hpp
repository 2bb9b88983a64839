// json_list.hpp - vectors and matrices as JSON.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

namespace kreisel::core {

/// A vector's components.
[[nodiscard]] inline nlohmann::json json_list(const Eigen::Ref<const Eigen::VectorXd>& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

/// A matrix as a list of its rows.
[[nodiscard]] inline nlohmann::json json_rows(const Eigen::Matrix3d& m) {
  nlohmann::json rows = nlohmann::json::array();
  for (int row = 0; row < 3; ++row) rows.push_back(json_list(m.row(row).transpose()));
  return rows;
}

}  // namespace kreisel::core
