// print_pieces.hpp - what of a part is printed by itself, and which way up.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/body.hpp"
#include "fabricate/parts.hpp"
#include "print/slice/infill.hpp"

namespace kreisel::core {

/// A part, or one of the pieces that it is cut into, or a half of a yo-yo. Model coordinates, mm.
struct PrintPiece {
  std::string name;  ///< empty: it is the whole part
  TriangleMesh outer;
  TriangleMesh cavity = {};   ///< its closed voids, normals into them
  TriangleMesh sparse = {};   ///< where there is infill in place of them, normals out of it
  Vec3 place = Vec3::Zero();  ///< near it (MaterialPart)
  Vec3 up = Vec3::UnitZ();    ///< of the print
  double density = 1;         ///< g/cm^3, of what is full
  double sparse_density = 0;  ///< of what is sparse

  [[nodiscard]] Filled filled() const { return {outer, sparse, place}; }
  /// All of its surface. @pre  no infill
  [[nodiscard]] TriangleMesh surface() const;
};

/// Each stands on the cut that it has. A half of a yo-yo stands on the side towards the other half.
/// @param solids  of one material, or with infill: a full part and what of it is sparse
/// @param usual   up, of pieces without a cut  @param asked  up is what was asked for, whatever cuts there
/// are
[[nodiscard]] std::vector<PrintPiece> print_pieces(const Body& body, const std::vector<MaterialPart>& solids,
                                                   bool infill, const Vec3& usual, bool asked);

/// STEM-PIECE beside `file`, or `file` itself for the whole part; empty stays empty.
[[nodiscard]] std::filesystem::path file_of_piece(const std::filesystem::path& file,
                                                  const std::string& piece);

}  // namespace kreisel::core
