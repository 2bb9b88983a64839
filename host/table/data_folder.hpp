// data_folder.hpp - where the experiments and the published numbers lie.
#pragma once

#include <filesystem>
#include <string_view>

namespace kreisel::core {

/// The folder of the data that comes with the program: $KREISEL_DATA when set, else ../share/kreisel beside
/// the folder of the executable, else the source tree the program was built from.
///
/// @throws InputError  none of them is a folder; names what was tried
[[nodiscard]] std::filesystem::path data_folder();

/// The JSON file of a paper's numbers, e.g. "rayrep_table2".
///
/// @throws InputError  no such file; names the nearest
[[nodiscard]] std::filesystem::path published_file(std::string_view name);

/// The script that draws a figure, e.g. "history".
///
/// @throws InputError  no such file; names the nearest
[[nodiscard]] std::filesystem::path figure_file(std::string_view name);

}  // namespace kreisel::core
