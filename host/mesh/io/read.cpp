#include "mesh/io/read.hpp"

#include <fmt/format.h>

#include <fstream>

#include "error.hpp"
#include "mesh/io/format.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status))
    throw InputError(fmt::format("{}: no such file, expected a mesh", path.string()));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a directory, expected a mesh file", path.string()));
  std::ifstream in(path, std::ios::binary);
  std::string bytes;
  constexpr std::size_t block = std::size_t{1} << 22;
  if (std::filesystem::is_regular_file(status))  // or it would be moved as it grows
    bytes.reserve(std::filesystem::file_size(path, ignored) + block);
  do {
    stop_here();
    const std::size_t so_far = bytes.size();
    bytes.resize(so_far + block);
    in.read(bytes.data() + so_far, block);
    bytes.resize(so_far + static_cast<std::size_t>(in.gcount()));
  } while (in);
  if (!in.eof())
    throw InputError(fmt::format("{}: cannot be opened, expected a readable file", path.string()));
  if (bytes.empty()) throw InputError(fmt::format("{}: empty file, expected a mesh", path.string()));
  return bytes;
}

}  // namespace

MeshReading read_mesh_file(const std::filesystem::path& path) {
  const MeshFormat& format = mesh_format(path);
  MeshReading reading = format.read({path.string(), contents(path)});
  if (reading.mesh.triangles.empty()) {
    std::string notes;
    for (const std::string& note : reading.notes) notes += "; " + note;
    throw InputError(fmt::format("{}: no triangles, expected at least one face{}", path.string(), notes));
  }
  return reading;
}

TriangleMesh read_mesh(const std::filesystem::path& path) { return read_mesh_file(path).mesh; }

std::vector<TriangleMesh> read_objects(const std::filesystem::path& path) {
  const MeshFormat& format = mesh_format(path);
  if (!format.read_objects) return {read_mesh(path)};
  return format.read_objects({path.string(), contents(path)});
}

}  // namespace kreisel::core
