// printed.hpp - a part as its G-code prints it.
#pragma once

#include <optional>
#include <vector>

#include "design/figures.hpp"
#include "design/print_pieces.hpp"
#include "print/slice/slice.hpp"
#include "session/solved_run.hpp"

namespace kreisel::core {

struct PrintSpec {
  SliceSpec slicing;       ///< no slicer: nothing is sliced
  std::optional<Vec3> up;  ///< of the print, model coordinates; default as the body stands: its axis, or up
  bool find_up = false;    ///< the one that needs least support where nobody gets at it
  /// Whether the cut is moved until the print does what was asked, not only the mesh.
  bool balance = false;

  [[nodiscard]] bool wanted() const { return !slicing.slicer.empty(); }
};

/// What a slicer makes of a piece.
struct PrintedPiece {
  std::string name;  ///< empty: it is the whole part
  Sliced sliced;
};

/// What a slicer makes of a part. Pieces are sliced one by one, each in the middle of the bed.
struct PrintedPart {
  std::vector<PrintedPiece> pieces;
  Moments
      moments;  ///< of all of them where they belong, with what is added to the body; body frame and units
  Figures figures;
  Residual residual{};

  /// Whether it does what was asked with so little amiss that another slicing could hardly make it less: 0.01
  /// mm, 0.02 degrees, a thousandth of its mass.
  [[nodiscard]] bool balances() const;
  [[nodiscard]] const Print& first() const { return pieces.front().sliced.print; }
  /// mm^3 of what is printed beside it: supports, skirts.
  [[nodiscard]] double beside() const;
};

/// Slices parts of one run, and has its problem judge what is printed.
class Printing {
 public:
  /// @throws InputError  no such slicer or profile; a pose without direction
  explicit Printing(const PrintSpec& spec);

  /// @param solids  of the part, model coordinates
  /// @throws InputError  as MeshSlicer  @throws Interrupted
  [[nodiscard]] PrintedPart operator()(const SolvedRun& run, const std::vector<MaterialPart>& solids,
                                       const Control& control) const;
  [[nodiscard]] std::vector<PrintPiece> pieces(const SolvedRun& run,
                                               const std::vector<MaterialPart>& solids) const;
  [[nodiscard]] const MeshSlicer& slicer() const { return slice_; }
  /// Which way is up.
  [[nodiscard]] Vec3 up_of(const RunResult& run) const {
    return up_.value_or(run.frame.rotation.row(2).transpose());
  }

 private:
  std::optional<Vec3> up_;
  bool infill_;
  MeshSlicer slice_;
};

}  // namespace kreisel::core
