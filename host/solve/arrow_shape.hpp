// arrow_shape.hpp - is a symmetric matrix a diagonal with a few dense rows?
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace kreisel::core {

/// Where the entries of a symmetric matrix are: each pair once, from `base` on; a pair may come again.
struct Pattern {
  int size = 0;
  int base = 0;  ///< the first index: 0, or 1 as in Fortran
  std::span<const int> rows, columns;
};

/// Rows of a block in front of the border, at most: two ends of a ray, their order's slack and multiplier.
inline constexpr int arrow_block = 4;

/// An arrow: the matrix of the rows outside the border falls into blocks of at most arrow_block rows that are
/// tied to each other through the border alone.
struct ArrowShape {
  std::vector<int> border;  ///< ascending, from 0
  /// At n - 1 the blocks of n rows, one after the other, each ascending.
  std::array<std::vector<int>, arrow_block> blocks;

  /// Rows with many entries go into the border, the longest first, until what is left falls apart.
  ///
  /// Cost: a few passes over the entries. @return nothing where the border would be longer than 64 rows and
  /// than an eighth of all, or than 512: then a sparse solver does better
  static std::optional<ArrowShape> of(const Pattern& pattern);
};

}  // namespace kreisel::core
