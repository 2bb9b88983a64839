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
#include "print/slice/infill.hpp"
#include "print/slice/slicer.hpp"

namespace kreisel::core {

struct SliceSpec {
  std::string slicer;                   ///< as Slicer takes it
  std::filesystem::path profile;        ///< in place of ours; empty: ours
  double seconds = 600;                 ///< that the slicer may take
  std::optional<Printer> printer = {};  ///< whose bed, nozzle and layers our profile has
  std::optional<Infill> infill = {};    ///< parts come as Filled, and are sliced as a project of 3MF
  threemf::Dialect dialect = threemf::Dialect::prusa;  ///< of that, for a command
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
  /// @throws InputError  no such slicer or profile, or one that opens no project where there is infill
  explicit MeshSlicer(const SliceSpec& spec);

  /// The whole of what decides how a part is sliced, but for the slicer's version.
  [[nodiscard]] std::string identity() const;
  /// One that makes supports wherever they are needed, within the part, too. Nothing: it cannot be told to.
  [[nodiscard]] std::optional<MeshSlicer> with_supports_everywhere() const;
  /// Where a part goes: with `up` upward, the lowest point at z = 0 and the middle of its outline above that
  /// of the bed. @param up  any length but zero
  [[nodiscard]] Eigen::Isometry3d placed(const TriangleMesh& mesh, const Vec3& up) const;

  /// A part with infill, where it lies with `up` upward, as slicers open it: with the settings that it is
  /// sliced with here.
  /// @param part  of a specification with infill
  [[nodiscard]] threemf::Project project(const Filled& part, const Vec3& up, threemf::Dialect dialect) const;

  /// @param mesh     closed, mm  @param up  of the print, in the mesh's coordinates; any length but zero
  /// @param density  of the filament, g/cm^3
  /// @throws InputError   the slicer fails, takes too long, or prints elsewhere
  /// @throws Interrupted  nothing is left behind
  [[nodiscard]] Sliced operator()(const TriangleMesh& mesh, const Vec3& up, double density,
                                  const Control& control) const;
  /// The same of a part with infill. @param part  of a specification with infill
  [[nodiscard]] Sliced operator()(const Filled& part, const Vec3& up, double density,
                                  const Control& control) const;

 private:
  [[nodiscard]] Sliced run(const std::string& bytes, const char* name, const TriangleMesh& laid,
                           const Eigen::Isometry3d& lay, double density, const Control& control) const;

  SliceSpec spec_;
  Slicer slicer_;
  SlicerSettings settings_;
};

}  // namespace kreisel::core
