#include <utility>

#include "error.hpp"
#include "fuzz/feed.hpp"
#include "mesh/io/format.hpp"
#include "mesh/solid/solid.hpp"

namespace kreisel::core::fuzz {

void feed_mesh(const std::string& extension, std::string bytes) try {
  // The pairs of triangles of a mesh without any order grow with its square.
  constexpr std::size_t most_triangles = 300;
  const std::string name = "fed." + extension;
  const MeshFormat& format = mesh_format(name);
  const MeshFile file{name, std::move(bytes)};
  MeshReading reading = format.read(file);
  if (format.read_objects) (void)format.read_objects(file);
  if (reading.mesh.triangles.empty() || reading.mesh.triangles.size() > most_triangles) return;
  (void)inspect(reading.mesh);
  Surface surface(std::move(reading.mesh), reading.weld);
  const SolidMesh solid = make_solid(surface, name);
  (void)format.encode({solid.mesh}, name);
} catch (const InputError&) {
}

}  // namespace kreisel::core::fuzz
