// printed.hpp - a part as its G-code prints it.
#pragma once

#include <optional>
#include <vector>

#include "design/figures.hpp"
#include "fabricate/parts.hpp"
#include "print/slice/slice.hpp"
#include "session/solved_run.hpp"

namespace kreisel::core {

struct PrintSpec {
  SliceSpec slicing;       ///< no slicer: nothing is sliced
  std::optional<Vec3> up;  ///< of the print, model coordinates; default as the body stands: its axis, or up
  /// Whether the cut is moved until the print does what was asked, not only the mesh.
  bool balance = false;

  [[nodiscard]] bool wanted() const { return !slicing.slicer.empty(); }
};

/// What a slicer makes of a part.
struct PrintedPart {
  Sliced sliced;
  Moments moments;  ///< body frame and units
  Figures figures;
  Residual residual{};

  /// Whether it does what was asked with so little amiss that another slicing could hardly make it less: 0.01
  /// mm, 0.02 degrees, a thousandth of its mass.
  [[nodiscard]] bool balances() const;
};

/// Slices parts of one run, and has its problem judge what is printed.
class Printing {
 public:
  /// @throws InputError  no such slicer or profile; a pose without direction
  explicit Printing(const PrintSpec& spec);

  /// @param solids  of the part, model coordinates
  /// @throws InputError  several solids; as MeshSlicer  @throws Interrupted
  [[nodiscard]] PrintedPart operator()(const SolvedRun& run, const std::vector<MaterialPart>& solids,
                                       const Control& control) const;

 private:
  std::optional<Vec3> up_;
  MeshSlicer slice_;
};

}  // namespace kreisel::core
