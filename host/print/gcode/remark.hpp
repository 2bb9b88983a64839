// remark.hpp - what slicers say in comments: five dialects in one table.
#pragma once

#include <optional>
#include <string_view>

namespace kreisel::core {

enum class Says {
  slicer,            ///< its name
  slicer_that_ends,  ///< the same; after all moves it writes what filament was used
  type,              ///< of what follows
  height,            ///< of its beads, mm
  layer,             ///< the next one begins; Cura: its number, below 0 of a raft
  layer_count,       ///< so many will follow
  object,            ///< its label
  object_ends,       ///
  purge,             ///< filament is flushed
  purge_ends,        ///
  diameters,         ///< of each tool's filament, mm
  densities,         ///< g/cm^3
  volumetric,        ///< whether E is in mm^3
  filament_used,     ///< of each tool, mm; all moves are behind us
  moves_begin,       ///< what `moves_end` or `filament_used` will end
  moves_end,
};

struct Remark {
  Says says;
  std::string_view value;  ///< without blanks around it
};

/// @param comment  without its semicolon
[[nodiscard]] std::optional<Remark> remark_of(std::string_view comment);

/// The type that a comment behind a move says, as Slic3r's do when it is asked to explain itself.
[[nodiscard]] bool is_type(std::string_view comment);

/// Whether what is of that type is the part itself. @param type  in any slicer's words
[[nodiscard]] bool is_of_part(std::string_view type);

/// Whether it is support, or between support and part.
[[nodiscard]] bool is_support(std::string_view type);

/// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace kreisel::core
