#include "fabricate/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "fabricate/lay_flat.hpp"
#include "file/beside.hpp"
#include "geometry/moved.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/format.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/solid/separate_edges.hpp"
#include "mesh/solid/solid.hpp"

namespace kreisel::core {

std::filesystem::path file_of_part(const std::filesystem::path& path, std::string_view name) {
  if (mesh_format(path).encode_objects || name == "part" || name == "shell") return path;
  return beside(path, std::string(name));
}

namespace {

bool is_laid(const MaterialPart& part) { return !part.laid.matrix().isIdentity(0); }

/// Whether single precision holds the parts where they are.
bool held_in_place(const std::vector<MaterialPart>& parts) {
  constexpr double of_length = 1e-5, finest = 4e-4;
  Box box;
  for (const MaterialPart& part : parts)
    for (const TriangleMesh& surface : part.surfaces)
      for (const Vec3& v : surface.vertices) box.add(v);
  const double spacing = single_spacing(box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).maxCoeff());
  if (spacing > std::min(of_length * box.extent().maxCoeff(), finest)) return false;
  return std::ranges::all_of(parts, [](const MaterialPart& part) {
    TriangleMesh mesh = in_single_precision(joined(part.surfaces, part.name));
    (void)separate_edges(mesh);
    try {
      require_sound(mesh, part.name);
      return true;
    } catch (const InputError&) {
      return false;
    }
  });
}

/// What is to be added to the coordinates of the parts for a file in single precision.
Vec3 move_for_single_precision(const std::vector<MaterialPart>& parts) {
  if (parts.empty() || parts.front().place.isZero(0) || is_laid(parts.front()) || held_in_place(parts))
    return Vec3::Zero();
  return Vec3::Zero() - parts.front().place;  // no -0
}

}  // namespace

std::vector<WrittenMaterial> write_parts(const std::filesystem::path& path,
                                         const std::vector<MaterialPart>& parts) {
  const MeshFormat& format = mesh_format(path);
  const Vec3 move =
      format.written == Precision::as_single ? move_for_single_precision(parts) : Vec3(Vec3::Zero());
  std::vector<WrittenMaterial> written;
  std::vector<MeshObject> objects;
  for (const MaterialPart& part : parts) {
    std::vector<TriangleMesh> surfaces = laid_surfaces(part);
    if (!move.isZero(0))
      for (TriangleMesh& surface : surfaces) surface = moved(std::move(surface), Eigen::Translation3d(move));
    objects.push_back({fmt::format("{}, {} g/cm^3", part.name, part.density), std::move(surfaces),
                       is_laid(part) ? std::nullopt : std::optional(part.place)});
    written.push_back({part.name, part.density, file_of_part(path, part.name), 0, 0,
                       Eigen::Translation3d(move) * part.laid, move});
  }
  if (format.encode_objects) {
    write_objects(path, objects);
    return written;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) write_mesh(written[i].file, objects[i].parts);
  return written;
}

TriangleMesh as_written(const WrittenMaterial& material, TriangleMesh mesh, const Vec3& place) {
  const Precision precision =
      material.file.empty() ? Precision::as_single_about_place : mesh_format(material.file).written;
  if (precision == Precision::as_double) return mesh;
  const Eigen::Affine3d to_file =
      precision == Precision::as_single ? material.laid : Eigen::Affine3d(Eigen::Translation3d(-place));
  return moved(in_single_precision(moved(std::move(mesh), to_file)), to_file.inverse());
}

TriangleMesh WrittenReader::next(WrittenMaterial& material) {
  if (material.file != open_) {
    objects_ = read_objects(material.file);
    open_ = material.file;
    next_ = 0;
  }
  if (next_ == objects_.size())
    throw InputError(fmt::format("{}: holds {} objects, expected one for each part", open_.string(), next_));
  TriangleMesh mesh = moved(std::move(objects_[next_++]), material.laid.inverse());
  material.triangles = mesh.triangles.size();
  // STL has no vertices of its own: where parts of the body touch along an edge, theirs became one.
  (void)separate_edges(mesh);
  return mesh;
}

namespace {

/// Adds what a mesh encloses to the part. @throws InputError  it is no solid
void add_solid(WrittenPart& part, WrittenMaterial& material, const TriangleMesh& mesh, const Body& body,
               const std::string& name) {
  const Moments own =
      material.density / body.density * reference::mesh_moments(to_body(body.frame, mesh)).value;
  material.grams = own[S1] * body.mass_grams();
  part.moments += own;
  require_sound(mesh, name);
}

/// @param add  adds the solid of that number, with its material
template <class Add>
WrittenPart judged(std::vector<WrittenMaterial> materials, const Body& body, const Problem& problem,
                   const Add& add) {
  WrittenPart part;
  part.materials = std::move(materials);
  std::string wrong;
  for (std::size_t i = 0; i < part.materials.size(); ++i) try {
      add(part, i);
    } catch (const InputError& error) {
      if (wrong.empty()) wrong = fmt::format("the written mesh is not a solid: {}", error.what());
    }
  part.moments += body.added;
  if (wrong.empty())
    part.verdict = problem.verify_at_rest(part.moments, body.frame.length);
  else
    part.verdict.text = wrong;
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
    const TriangleMesh mesh =
        as_written(part.materials[i], joined(parts[i].surfaces, parts[i].name), parts[i].place);
    part.materials[i].triangles = mesh.triangles.size();
    add_solid(part, part.materials[i], mesh, body, parts[i].name);
  });
}

}  // namespace kreisel::core
