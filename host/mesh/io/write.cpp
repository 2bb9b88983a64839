#include "mesh/io/write.hpp"

#include "file/write_text.hpp"
#include "mesh/io/format.hpp"

namespace kreisel::core {

void write_mesh(const std::filesystem::path& path, const std::vector<TriangleMesh>& parts) {
  write_text(path, mesh_format(path).encode(parts, path.string()));
}

void write_objects(const std::filesystem::path& path, const std::vector<MeshObject>& objects) {
  write_text(path, mesh_format(path).encode_objects(objects, path.string()));
}

}  // namespace kreisel::core
