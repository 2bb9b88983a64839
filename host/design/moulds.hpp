// moulds.hpp - moulds for what of a part is to be cast.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fabricate/mould.hpp"

namespace kreisel::core {

/// A mould as it was written.
struct WrittenMould {
  std::string of;      ///< name of the part's material: interior, filling
  double density = 1;  ///< of what is cast, g/cm^3
  Mould mould;
  std::vector<std::filesystem::path> files;
};

/// The solids of a part that are cast: those denser than the body's shell. @param least  mm^3, as
/// castings_of()
/// @throws InputError  one that cannot be cast in two halves
[[nodiscard]] std::vector<MaterialPart> cast_of(const std::vector<MaterialPart>& parts, double shell_density,
                                                double least);

/// Writes a mould for each, beside `file` and in its format, and reads it again: all its parts are solids.
/// NAME-interior-mould-upper.stl and so on; of several solids of one material with a number behind.
/// @throws InputError  a file that cannot be written
[[nodiscard]] std::vector<WrittenMould> write_moulds(const std::filesystem::path& file,
                                                     const std::vector<MaterialPart>& cast);

}  // namespace kreisel::core
