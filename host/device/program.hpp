// program.hpp - builds an embedded kernel source for a device, with a cache of binaries on disk.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "device/device.hpp"

namespace kreisel::core::device {

/// The program of kernels/`stem`.cl for this device, in its precision, with its lanes and work-group
/// (kernels/real.h). Built once a device.
///
/// Binaries are kept under cache_folder(), keyed by source, options, device and driver; a binary that the
/// driver refuses is built anew from source.
///
/// @param options  further compiler options, such as "-DENDS=1"
/// @throws Error   the build failed; carries the build log
cl::Program build(const Device& device, std::string_view stem, const std::string& options = {});

/// The same for a source that is not embedded; `name` stands in messages.
cl::Program build_source(const Device& device, std::string_view name, std::string_view source,
                         const std::string& options);

/// KREISEL_CACHE_DIR, else XDG_CACHE_HOME/kreisel, else ~/.cache/kreisel.
std::filesystem::path cache_folder();

/// Key of a binary: 32 hexadecimal digits over everything that can change it.
std::string cache_key(const Device& device, std::string_view source, const std::string& options);

}  // namespace kreisel::core::device
