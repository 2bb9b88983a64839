// kept_weights.hpp - weights that took long, kept on disk.
#pragma once

#include <filesystem>
#include <optional>

#include "deform/biharmonic_weights.hpp"

namespace kreisel::core {

/// The file of a cage's weights in device::cache_folder(), keyed by all that they depend on.
[[nodiscard]] std::filesystem::path kept_at(const Cage& cage);

/// Nothing where there is no such file, or it is damaged. The seconds are 0.
[[nodiscard]] std::optional<BiharmonicWeights> read_weights(const std::filesystem::path& path,
                                                            const Cage& cage);

/// Best effort: a cache that cannot be written only costs time.
void write_weights(const std::filesystem::path& path, const BiharmonicWeights& weights);

}  // namespace kreisel::core
