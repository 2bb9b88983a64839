#include "design/print_pieces.hpp"

#include <utility>

#include "fabricate/write_halves.hpp"
#include "file/beside.hpp"
#include "mesh/io/encode.hpp"

namespace kreisel::core {
namespace {

/// The half of a piece that is above the middle of the axle, or below it.
PrintPiece half_piece(const Body& body, const PrintPiece& whole, bool upper) {
  const auto half = [&](const TriangleMesh& mesh) { return half_along_axle(body.frame, mesh, upper); };
  PrintPiece piece = whole;
  piece.name = upper ? "upper" : "lower";
  piece.outer = half(whole.outer);
  piece.cavity = half(whole.cavity);
  piece.sparse = half(whole.sparse);
  return piece;
}

}  // namespace

TriangleMesh PrintPiece::surface() const {
  return cavity.triangles.empty() ? outer : joined({outer, cavity}, "the part");
}

std::vector<PrintPiece> print_pieces(const Body& body, const std::vector<MaterialPart>& solids, bool infill,
                                     const Vec3& usual, bool asked) {
  std::vector<PrintPiece> pieces;
  for (const MaterialPart& solid : solids) {
    PrintPiece piece{solids.size() == 1 || infill ? "" : solid.name, solid.surfaces.front()};
    if (solid.surfaces.size() > 1)
      piece.cavity = joined({solid.surfaces.begin() + 1, solid.surfaces.end()}, "the part");
    piece.place = solid.place;
    piece.up = asked || solid.down.isZero(0) ? usual : Vec3(-solid.down);
    piece.density = solid.density;
    pieces.push_back(std::move(piece));
    if (!infill) continue;
    if (solids.size() > 1) {
      pieces.front().cavity = {};
      pieces.front().sparse = solids[1].surfaces.front();
      pieces.front().sparse_density = solids[1].density;
    }
    break;
  }
  if (!body.axle) return pieces;
  std::vector<PrintPiece> halves;
  for (const PrintPiece& piece : pieces)
    for (const bool upper : {true, false}) {
      halves.push_back(half_piece(body, piece, upper));
      if (!asked) halves.back().up = (upper ? 1 : -1) * body.frame.rotation.row(2).transpose();
    }
  return halves;
}

std::filesystem::path file_of_piece(const std::filesystem::path& file, const std::string& piece) {
  return file.empty() || piece.empty() ? file : beside(file, piece);
}

}  // namespace kreisel::core
