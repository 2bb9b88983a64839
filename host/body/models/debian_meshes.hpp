// debian_meshes.hpp - real meshes by name, from Debian's package libcgal-demo where it is installed.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A mesh of the package's archive, and which way up it stands.
struct DebianMesh {
  static constexpr double size = 60;  ///< mm, longest side: the files have no unit
  std::string_view name, file, summary;
  Vec3 up = Vec3::UnitZ();
};

/// Every known mesh, in the order `bench list` prints.
[[nodiscard]] const std::vector<DebianMesh>& debian_meshes();

/// The mesh of that name, or nullptr.
[[nodiscard]] const DebianMesh* find_debian_mesh(std::string_view name);

/// Where the package puts its archive.
[[nodiscard]] std::filesystem::path debian_archive();
[[nodiscard]] bool debian_meshes_installed();

/// Unpacks one mesh in memory, as it is in its file; up to half a second, most of it decompression.
/// @param archive  a compressed tar with data/meshes/FILE
/// @throws InputError  the package is not installed (says how to get it), the archive is damaged or has no
///                     such mesh, or the mesh is not OFF
[[nodiscard]] TriangleMesh read_debian_mesh(const DebianMesh& mesh,
                                            const std::filesystem::path& archive = debian_archive());

}  // namespace kreisel::core
