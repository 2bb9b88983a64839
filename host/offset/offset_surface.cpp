#include "offset/offset_surface.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "error.hpp"
#include "openvdb/module.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

/// Where the module may lie: ../lib/kreisel beside the program's folder, or where it was built.
std::vector<fs::path> module_files() {
  std::vector<fs::path> files;
  std::error_code error;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error)
    files.push_back(program.parent_path().parent_path() / "lib" / "kreisel" / openvdb_module::file);
  files.push_back(fs::path(KREISEL_MODULES) / openvdb_module::file);
  return files;
}

// Loaded when it is first asked for: OpenVDB's libraries take more address space than all else that a program
// needs to start.
openvdb_module::Offset* load() {
  std::string why;
  for (const fs::path& file : module_files()) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
      why += fmt::format("{}{}: no such file", why.empty() ? "" : "; ", file.string());
      continue;
    }
    void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const function = module ? dlsym(module, openvdb_module::function) : nullptr;
    if (!function) throw InputError(fmt::format("offsets need OpenVDB: {}", dlerror()));
    return reinterpret_cast<openvdb_module::Offset*>(function);
  }
  throw InputError(fmt::format("offsets need OpenVDB: {}; expected it there", why));
}

/// More voxels than this along the box's longest side, or within the distance, are a mistake of units.
constexpr double most_cells = 2048;

}  // namespace

TriangleMesh offset_surface(const TriangleMesh& mesh, double distance, double voxel) {
  if (mesh.triangles.empty())
    throw InputError("offset of a mesh without triangles; expected the surface of a solid");
  if (!std::isfinite(distance) || distance == 0 || !std::isfinite(voxel) || !(voxel > 0))
    throw InputError(fmt::format(
        "offset by {} in voxels of {}; expected a distance that is not 0 and an edge > 0", distance, voxel));
  const Vec3 extent = bounding_box(mesh).extent();
  if (distance < 0 && 2 * -distance >= extent.minCoeff()) return {};
  const double cells = (extent.maxCoeff() + 2 * std::max(distance, 0.0)) / voxel;
  if (!(cells <= most_cells))
    throw InputError(
        fmt::format("offset by {:g} in voxels of {:g} takes {:.0f} of them along a side; expected "
                    "at most {:.0f}",
                    distance, voxel, cells, most_cells));
  static openvdb_module::Offset* const offset = load();
  TriangleMesh result;
  offset(mesh, distance, voxel, result);
  return result;
}

}  // namespace kreisel::core
