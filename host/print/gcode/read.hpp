// read.hpp - G-code as PrusaSlicer, Slic3r, CuraEngine, OrcaSlicer and Bambu Studio write it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "print/gcode/print.hpp"

namespace kreisel::core {

/// What the user says of the filament, in place of what the file does.
struct FilamentSpec {
  std::optional<double> diameter, density;  ///< mm; g/cm^3
};

/// Reads G-code as it comes, in blocks of any size. What it keeps does not grow with the file, but for a
/// line for each layer and label.
class GcodeReader {
 public:
  /// @param name  of the file, for messages
  explicit GcodeReader(std::string name);
  ~GcodeReader();
  GcodeReader(const GcodeReader&) = delete;
  GcodeReader& operator=(const GcodeReader&) = delete;

  /// @throws InputError  file and line, what is wrong, what was expected
  void feed(std::string_view block);
  /// Once, after the last block. @throws InputError  nothing is printed, or the file was cut off
  [[nodiscard]] Print finish(const FilamentSpec& spec = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether the name is that of G-code: .gcode, .gco, .g, .nc, in any case.
[[nodiscard]] bool is_gcode(const std::filesystem::path& file);

/// @throws InputError  as GcodeReader; a file that cannot be read  @throws Interrupted
[[nodiscard]] Print read_gcode(const std::filesystem::path& file, const FilamentSpec& spec = {});

}  // namespace kreisel::core
