// slice.hpp - from a mesh to what its G-code prints.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control.hpp"
#include "geometry/triangle_mesh.hpp"
#include "print/gcode/print.hpp"
#include "print/slice/slicer.hpp"

namespace kreisel::core {

struct SliceSpec {
  std::string slicer;             ///< as Slicer takes it
  std::filesystem::path profile;  ///< in place of ours; empty: ours
  double seconds = 600;           ///< that the slicer may take
};

struct Sliced {
  std::filesystem::path gcode;  ///< lies there as long as somebody has this, or a copy
  std::shared_ptr<const void> folder;
  Print print;
  SlicerSettings settings;         ///< that it was given
  Eigen::Isometry3d bed_to_model;  ///< from the coordinates of the G-code to those of the mesh
};

/// Keeps its G-code under that name. @throws InputError  see replace_file()
void write_gcode(const Sliced& sliced, const std::filesystem::path& file);

/// Lays a mesh on the bed, slices it and reads what is printed.
class MeshSlicer {
 public:
  /// @throws InputError  no such slicer or profile
  explicit MeshSlicer(const SliceSpec& spec);

  /// @param mesh     closed, mm  @param up  of the print, in the mesh's coordinates; any length but zero
  /// @param density  of the filament, g/cm^3
  /// @throws InputError   the slicer fails, takes too long, or prints elsewhere
  /// @throws Interrupted  nothing is left behind
  [[nodiscard]] Sliced operator()(const TriangleMesh& mesh, const Vec3& up, double density,
                                  const Control& control) const;

 private:
  SliceSpec spec_;
  Slicer slicer_;
  SlicerSettings settings_;
};

}  // namespace kreisel::core
