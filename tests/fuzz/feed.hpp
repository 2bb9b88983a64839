// feed.hpp - bytes for a reader, as if a file held them.
#pragma once

#include <string>

namespace kreisel::core::fuzz {

/// A mesh file of that extension, as every program takes it: read, mended, checked. What is refused as bad
/// input is well; whatever else a reader throws is not caught.
void feed_mesh(const std::string& extension, std::string bytes);

/// An experiment's TOML.
void feed_experiment(const std::string& text);

/// G-code. Aborts where what is read has no mass.
void feed_gcode(const std::string& text);

}  // namespace kreisel::core::fuzz
