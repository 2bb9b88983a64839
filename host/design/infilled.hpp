// infilled.hpp - a part with sparse infill in place of voids: one file for one print.
#pragma once

#include <filesystem>
#include <vector>

#include "design/print_pieces.hpp"
#include "fabricate/verify.hpp"
#include "print/slice/infill_density.hpp"
#include "print/slice/slice.hpp"
#include "session/make_part.hpp"

namespace kreisel::core {

/// What is printed sparsely of a part, and how much that holds.
struct InfillUse {
  Infill infill;
  InfillDensity density;
  double share = 0;                ///< of what is full, as the part was solved with
  double volume = 0, surface = 0;  ///< of what is sparse, mm^3 and mm^2
};

/// mm^2, of a mesh in mm.
[[nodiscard]] double area_of(const TriangleMesh& mesh);

/// What its infill will hold of what is full. That depends on how much boundary it has, so a part is made
/// ahead, with what its whole interior would hold. Changes the density of the configuration's voids.
/// @param config  without density of voids  @param options  of the part
/// @throws InputError, Interrupted
[[nodiscard]] InfillUse use_infill(Session& session, RunConfig& config, const InfillDensity& density,
                                   const Infill& infill, const PartOptions& options, const Control& control);

/// Writes pieces as slicers open them, ready to be sliced, a file each (file_of_piece()), and judges what the
/// files hold: outer surfaces with their own density, and within them the sparse regions with that of the
/// voids.
/// @param file  empty: nothing is written, but judged in the same way
[[nodiscard]] WrittenPart write_infilled(const std::filesystem::path& file,
                                         const std::vector<PrintPiece>& pieces, const MeshSlicer& slicer,
                                         threemf::Dialect dialect, const SolvedRun& run);

}  // namespace kreisel::core
