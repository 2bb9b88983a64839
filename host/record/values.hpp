// values.hpp - what can be a field of a result, in a file and in JSON.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "error.hpp"
#include "record/hdf5_file.hpp"

namespace kreisel::core::fields {

/// The values of an enumeration whose name in files is to_string(value); specialise it with `all`.
template <class E>
struct Names;

template <class T>
concept Named = requires {
  Names<T>::all;
};

template <Named E>
[[nodiscard]] E named(std::string_view text) {
  for (const E value : Names<E>::all)
    if (to_string(value) == text) return value;
  throw InputError("'" + std::string(text) + "' is no value that this program knows; a newer one wrote it");
}

/// Matrices and vectors of fixed size: a dataset each.
template <class T>
concept Matrix = requires(T m) {
  { T::RowsAtCompileTime } -> std::convertible_to<int>;
  m.data();
};

template <Matrix M>
[[nodiscard]] std::vector<double> numbers_of(const M& m) {
  std::vector<double> values;
  for (Eigen::Index row = 0; row < m.rows(); ++row)
    for (Eigen::Index column = 0; column < m.cols(); ++column) values.push_back(m(row, column));
  return values;
}

template <Matrix M>
void assign(M& m, const std::vector<double>& values, const std::string& what) {
  if (values.size() != static_cast<std::size_t>(m.size()))
    throw InputError(what + " has " + std::to_string(values.size()) + " numbers, expected " +
                     std::to_string(m.size()));
  std::size_t at = 0;
  for (Eigen::Index row = 0; row < m.rows(); ++row)
    for (Eigen::Index column = 0; column < m.cols(); ++column) m(row, column) = values[at++];
}

/// As JSON. Lines of text are a list, no number is null.
template <class T>
[[nodiscard]] nlohmann::json json_of(const T& value) {
  if constexpr (Named<T>) {
    return std::string(to_string(value));
  } else if constexpr (Matrix<T>) {
    if constexpr (T::ColsAtCompileTime == 1) {
      return numbers_of(value);
    } else {
      nlohmann::json rows = nlohmann::json::array();
      for (Eigen::Index row = 0; row < value.rows(); ++row)
        rows.push_back(numbers_of(value.row(row).transpose().eval()));
      return rows;
    }
  } else if constexpr (std::same_as<T, std::filesystem::path>) {
    return value.string();
  } else if constexpr (std::same_as<T, std::optional<double>>) {
    return value ? nlohmann::json(*value) : nlohmann::json();
  } else {
    return value;
  }
}

}  // namespace kreisel::core::fields
