#include "print/slice/slice.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "error.hpp"
#include "file/replace_file.hpp"
#include "file/write_text.hpp"
#include "geometry/box.hpp"
#include "geometry/moved.hpp"
#include "geometry/rotation.hpp"
#include "mesh/io/encode.hpp"
#include "print/gcode/read.hpp"
#include "program/run_program.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, gone with the object.
class WorkFolder {
 public:
  WorkFolder() {
    std::string name = (fs::temp_directory_path() / "kreisel-slice-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw InputError(fmt::format("{}: {}, expected room for a folder", name, std::strerror(errno)));
    path_ = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  [[nodiscard]] fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// @throws InputError  the slicer moved it
void require_in_place(const Print& print, const Box& mesh, const std::string& slicer) {
  // Paths run inside the outline by half a width, and a layer more or less is printed.
  constexpr double most = 1;
  const Vec3 off = (print.part.centre() - mesh.centre()).cwiseAbs();
  if (off.maxCoeff() < most) return;
  throw InputError(
      fmt::format("--slicer {}: its print lies {:.3g}, {:.3g}, {:.3g} mm off the model, expected a slicer "
                  "that leaves the model where it is",
                  slicer, off[0], off[1], off[2]));
}

}  // namespace

void write_gcode(const Sliced& sliced, const fs::path& file) {
  replace_file(file, [&](const fs::path& temporary) {
    fs::copy_file(sliced.gcode, temporary, fs::copy_options::overwrite_existing);
  });
}

MeshSlicer::MeshSlicer(const SliceSpec& spec)
    : spec_(spec),
      slicer_(spec.slicer),
      settings_(spec.profile.empty() ? slicer_.usual() : read_profile(spec.profile)) {
  if (spec.infill && !slicer_.opens_projects())
    throw InputError(fmt::format(
        "--infill by {}, expected prusa-slicer, or a command that opens projects of 3MF", spec.slicer));
  spec_.dialect = slicer_.dialect(spec.dialect);
  if (spec.printer && spec.profile.empty())
    for (const auto& [key, value] : slicer_.usual_on(*spec.printer)) settings_[key] = value;
}

std::string MeshSlicer::identity() const {
  return fmt::format("{}\n{}\n{}", spec_.slicer, spec_.dialect == threemf::Dialect::prusa ? "prusa" : "orca",
                     profile_text(settings_));
}

std::optional<MeshSlicer> MeshSlicer::with_supports_everywhere() const {
  MeshSlicer other = *this;
  const SlicerSettings settings = slicer_.supports_everywhere();
  if (settings.empty()) return std::nullopt;
  for (const auto& [key, value] : settings) other.settings_[key] = value;
  return other;
}

Eigen::Isometry3d MeshSlicer::placed(const TriangleMesh& mesh, const Vec3& up) const {
  Eigen::Isometry3d lay = Eigen::Isometry3d::Identity();
  lay.linear() = axis_to_z(up);
  const Box box = bounding_box(moved(mesh, lay).vertices);
  lay.translation() = slicer_.middle(settings_) - Vec3(box.centre()[0], box.centre()[1], box.lo[2]);
  return lay;
}

threemf::Project MeshSlicer::project(const Filled& part, const Vec3& up, threemf::Dialect dialect) const {
  threemf::Project project = project_of(part, spec_.infill.value(), dialect, placed(part.outer, up));
  project.settings.assign(settings_.begin(), settings_.end());
  return project;
}

Sliced MeshSlicer::operator()(const TriangleMesh& mesh, const Vec3& up, double density,
                              const Control& control) const {
  const StopScope scope(control.stop);
  const Eigen::Isometry3d lay = placed(mesh, up);
  const TriangleMesh laid = moved(mesh, lay);
  return run(encode_stl({laid}, "the part"), "part.stl", laid, lay, density, control);
}

Sliced MeshSlicer::operator()(const Filled& part, const Vec3& up, double density,
                              const Control& control) const {
  const StopScope scope(control.stop);
  const threemf::Project laid = project(part, up, spec_.dialect);
  return run(encode_project(laid, spec_.dialect, "the part"), "part.3mf", moved(part.outer, laid.to_bed),
             laid.to_bed, density, control);
}

Sliced MeshSlicer::run(const std::string& bytes, const char* name, const TriangleMesh& laid,
                       const Eigen::Isometry3d& lay, double density, const Control& control) const {
  control.tell(fmt::format("slice by {}", spec_.slicer));
  const auto made = std::make_shared<const WorkFolder>();
  const WorkFolder& folder = *made;
  const SlicerCall call{folder / name, folder / "part.gcode", folder / "profile.ini", settings_};
  write_text(call.model, bytes);
  write_text(call.profile, profile_text(settings_));
  const ProgramEnd end = run_program({.words = slicer_.words(call),
                                      .kept = ProgramSpec::Kept::all,
                                      .seconds = spec_.seconds,
                                      .stop = control.stop});
  control.stop_if_asked();
  if (end.by == ProgramEnd::By::time)
    throw InputError(
        fmt::format("--slicer {}: took more than {:.4g} s and was ended, expected a coarser part or profile",
                    spec_.slicer, spec_.seconds));
  if (end.code != 0 || !fs::exists(call.gcode))
    throw InputError(
        fmt::format("--slicer {}: ended with code {} {} G-code, expected some; its last words: {}",
                    spec_.slicer, end.code, fs::exists(call.gcode) ? "after" : "without", end.last_words));
  control.tell("read the G-code");
  FilamentSpec filament;
  filament.density = density;
  if (const double diameter = slicer_.diameter(settings_); diameter > 0) filament.diameter = diameter;
  Sliced sliced{call.gcode, made, read_gcode(call.gcode, filament), settings_, lay.inverse()};
  require_in_place(sliced.print, bounding_box(laid.vertices), spec_.slicer);
  return sliced;
}

}  // namespace kreisel::core
