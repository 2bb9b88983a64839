#include "fabricate/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "fabricate/lay_flat.hpp"
#include "geometry/moved.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/format.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/separate_edges.hpp"

namespace kreisel::core {

std::filesystem::path file_of_part(const std::filesystem::path& path, std::string_view name) {
  if (mesh_format(path).encode_objects || name == "part" || name == "shell") return path;
  return path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), name, path.extension().string());
}

std::vector<WrittenMaterial> write_parts(const std::filesystem::path& path,
                                         const std::vector<MaterialPart>& parts) {
  std::vector<WrittenMaterial> written;
  std::vector<MeshObject> objects;
  for (const MaterialPart& part : parts) {
    objects.push_back({fmt::format("{}, {} g/cm^3", part.name, part.density), laid_surfaces(part)});
    written.push_back({part.name, part.density, file_of_part(path, part.name), 0, 0, part.laid});
  }
  if (mesh_format(path).encode_objects) {
    write_objects(path, objects);
    return written;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) write_mesh(written[i].file, objects[i].parts);
  return written;
}

TriangleMesh WrittenReader::next(WrittenMaterial& material) {
  if (material.file != open_) {
    objects_ = read_objects(material.file);
    open_ = material.file;
    next_ = 0;
  }
  if (next_ == objects_.size())
    throw InputError(fmt::format("{}: {} objects, expected one more", open_.string(), next_));
  TriangleMesh mesh = moved(std::move(objects_[next_++]), material.laid.inverse());
  material.triangles = mesh.triangles.size();
  // STL has no vertices of its own: where parts of the body touch along an edge, theirs became one.
  (void)separate_edges(mesh);
  return mesh;
}

namespace {

/// Adds a solid to the part. @throws InputError  it is none
void add_solid(WrittenPart& part, WrittenMaterial& material, const TriangleMesh& mesh, const Body& body,
               const std::string& name) {
  require_solid(mesh, name);
  const Moments own =
      material.density / body.density * reference::mesh_moments(to_body(body.frame, mesh)).value;
  material.grams = own[S1] * body.mass_grams();
  part.moments += own;
}

/// @param add  adds the solid of that number, with its material
template <class Add>
WrittenPart judged(std::vector<WrittenMaterial> materials, const Body& body, const Problem& problem,
                   const Add& add) {
  WrittenPart part;
  part.materials = std::move(materials);
  for (std::size_t i = 0; i < part.materials.size(); ++i) try {
      add(part, i);
    } catch (const InputError& error) {
      part.verdict.text = fmt::format("the written mesh is not a solid: {}", error.what());
      return part;
    }
  part.moments += body.added;
  part.verdict = problem.verify(part.moments, body.frame.length);
  return part;
}

}  // namespace

WrittenPart verify_written(std::vector<WrittenMaterial> materials, const Body& body, const Problem& problem) {
  WrittenReader reader;
  return judged(std::move(materials), body, problem, [&](WrittenPart& part, std::size_t i) {
    WrittenMaterial& material = part.materials[i];
    const TriangleMesh mesh = reader.next(material);
    add_solid(part, material, mesh, body, material.file.filename().string());
  });
}

WrittenPart verify_made(const std::vector<MaterialPart>& parts, const Body& body, const Problem& problem) {
  std::vector<WrittenMaterial> materials;
  for (const MaterialPart& part : parts) materials.push_back({part.name, part.density, {}, 0, 0, part.laid});
  return judged(std::move(materials), body, problem, [&](WrittenPart& part, std::size_t i) {
    const TriangleMesh mesh = in_single_precision(joined(parts[i].surfaces, parts[i].name));
    part.materials[i].triangles = mesh.triangles.size();
    add_solid(part, part.materials[i], mesh, body, parts[i].name);
  });
}

}  // namespace kreisel::core
