#include "mesh/read.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "mesh/read_obj.hpp"
#include "mesh/read_off.hpp"
#include "mesh/read_stl.hpp"

namespace kreisel {
namespace {

using Reader = TriangleMesh (*)(const MeshFile&);

Reader reader_for(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (extension == ".stl") return read_stl;
  if (extension == ".obj") return read_obj;
  if (extension == ".off") return read_off;
  throw InputError(fmt::format("{}: extension '{}', expected .stl, .obj or .off", path.string(),
                               path.extension().string()));
}

std::string contents(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status))
    throw InputError(fmt::format("{}: no such file, expected a mesh", path.string()));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a directory, expected a mesh file", path.string()));
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.good() && !in.eof())
    throw InputError(fmt::format("{}: cannot be opened, expected a readable file", path.string()));
  if (bytes.empty()) throw InputError(fmt::format("{}: empty file, expected a mesh", path.string()));
  return bytes;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const Reader reader = reader_for(path);
  TriangleMesh mesh = reader({path.string(), contents(path)});
  if (mesh.triangles.empty())
    throw InputError(fmt::format("{}: no triangles, expected at least one face", path.string()));
  return mesh;
}

}  // namespace kreisel
