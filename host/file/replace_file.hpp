// replace_file.hpp - a file appears whole or not at all.
#pragma once

#include <filesystem>
#include <functional>

namespace kreisel::core {

/// Where a name leads: links are followed, also one whose target is yet to be made.
[[nodiscard]] std::filesystem::path written_path(const std::filesystem::path& path);

/// Whether what is at the name is written to as it is, for it is no file that could be replaced: a pipe, a
/// device, or what is open already (/dev/stdout).
[[nodiscard]] bool is_written_in_place(const std::filesystem::path& path);

/// Lets `write` fill a temporary name in the folder of `path`, then renames it to `path`, or to what a link
/// of that name leads to. Creates the folder. Keeps the permissions of an earlier file. Removes what a killed
/// run left of the same name, as seen at the first write into the folder. Whatever goes wrong, an earlier
/// file at `path` stays as it was and no temporary file is left. What is written in place gets the bytes once
/// they are whole.
///
/// @throws InputError  no such folder can be made, or the name is taken by one, or what is written in place
///                     takes no more; whatever `write` throws
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

/// Removes the temporary files that are being filled, for a program that ends at once. May be called by a
/// signal handler.
void remove_temporary_files() noexcept;

}  // namespace kreisel::core
