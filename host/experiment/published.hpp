// published.hpp - a paper's own numbers, read from results/published.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kreisel {

/// One row of a published table; what the table has not is empty.
struct PublishedRow {
  struct Side {
    int variables = 0;
    double seconds = 0;
  };
  std::string model;
  std::array<int, 3> grid{};  ///< cells along x, y, z
  std::optional<Side> rayrep, voxel;
  std::optional<double> speedup;  ///< as printed there, from times that were not rounded
};

struct Published {
  std::string source, machine;
  std::vector<PublishedRow> rows;

  /// The row, or nullptr.
  [[nodiscard]] const PublishedRow* find(const std::string& model, const std::array<int, 3>& grid) const;
};

/// @throws InputError  unreadable, not JSON, or a field missing or of another type; names file and fault
[[nodiscard]] Published read_published(const std::filesystem::path& file);

}  // namespace kreisel
