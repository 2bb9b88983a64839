// replace_file.hpp - a file appears whole or not at all.
#pragma once

#include <filesystem>
#include <functional>

namespace kreisel::core {

/// Lets `write` fill a temporary name in the folder of `path`, then renames it to `path`. Creates the folder.
/// Removes what a killed run left of the same name. Whatever goes wrong, an earlier file at `path` stays as
/// it was and no temporary file is left.
///
/// @throws InputError  no such folder can be made, or the name is taken by one; whatever `write` throws
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

}  // namespace kreisel::core
