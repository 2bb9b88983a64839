// slicer.hpp - programs that make G-code of a mesh, and how each is told what.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mesh/io/threemf/project.hpp"
#include "print/printer/printer.hpp"
#include "print/slice/profile.hpp"

namespace kreisel::core {

/// How a slicer is called for one part.
struct SlicerCall {
  std::filesystem::path model, gcode, profile;  ///< files: in, out, and the settings' own
  SlicerSettings settings;
};

/// A slicer that is known, or a command.
class Slicer {
 public:
  /// @param command  prusa-slicer, cura-engine, or such a program's file; or any other command, whose words
  ///                 {model}, {gcode} and {profile} stand for files
  /// @throws InputError  no such program: what to install; a command without {model} and {gcode}
  explicit Slicer(const std::string& command);

  /// Of ours: layers of 0.2 mm, a nozzle of 0.4 mm, two perimeters, filled, supports from the bed; empty of a
  /// command.
  [[nodiscard]] const SlicerSettings& usual() const { return usual_; }
  /// What of ours is another on that printer: bed, nozzle, layers; empty of a command.
  [[nodiscard]] SlicerSettings usual_on(const Printer& printer) const;
  /// Whether a project of 3MF says to it what is printed how.
  [[nodiscard]] bool opens_projects() const { return manner_ != Manner::cura; }
  /// Of the projects that it opens. @param wanted  what a command is given
  [[nodiscard]] threemf::Dialect dialect(threemf::Dialect wanted) const {
    return manner_ == Manner::prusa ? threemf::Dialect::prusa : wanted;
  }
  /// What makes supports wherever they are needed, within the part, too; empty of a command.
  [[nodiscard]] SlicerSettings supports_everywhere() const;
  /// Where the middle of a part goes: that of the bed, mm.
  [[nodiscard]] Vec3 middle(const SlicerSettings& settings) const;
  /// Of the filament, where the settings say it and G-code does not, mm; else 0.
  [[nodiscard]] double diameter(const SlicerSettings& settings) const;
  /// The program and its arguments. @throws InputError  a file that it needs is missing
  [[nodiscard]] std::vector<std::string> words(const SlicerCall& call) const;

 private:
  enum class Manner { prusa, cura, command };
  std::string program_;
  std::vector<std::string> command_;
  Manner manner_;
  SlicerSettings usual_;
};

}  // namespace kreisel::core
