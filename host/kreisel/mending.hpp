// mending.hpp - how far a mesh may be mended to become a solid.
#pragma once

#include <optional>
#include <vector>

namespace kreisel {

/// What a place is that the surface winds around inside out.
enum class InsideOut { refused, solid, empty };

/// What the user allows beyond the repairs that change nothing. [docs/meshes.md]
struct Mending {
  std::optional<double> weld = {};  ///< corners this near at open edges become one, mm; default as the file's
                                    ///< digits say
  std::optional<double> close_holes =
      {};  ///< holes no larger across are closed by a patch, mm; default none are
  InsideOut inside_out = InsideOut::refused;
  std::vector<int> pieces = {};  ///< of several pieces that do not touch those that are meant, by weight,
                                 ///< from 1; empty: there may be one alone

  bool operator==(const Mending&) const = default;
};

}  // namespace kreisel
