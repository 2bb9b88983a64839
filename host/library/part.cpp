#include <fmt/format.h>

#include "fabricate/lay_flat.hpp"
#include "geometry/single_precision.hpp"
#include "library/config_of.hpp"
#include "library/state.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/read.hpp"

namespace kreisel {
namespace {

/// From model coordinates to those of a file: a part far from the origin may have been moved (write_parts()).
Eigen::Affine3d laid_of(const std::vector<core::TriangleMesh>& objects, const core::Body& body) {
  const core::Box model = core::bounding_box(body.mesh);
  core::Box file;
  for (const core::TriangleMesh& mesh : objects)
    for (const Vec3& v : mesh.vertices) file.add(v);
  const Vec3 place = core::place_of(model), apart = file.centre() - model.centre();
  Eigen::Affine3d laid = Eigen::Affine3d::Identity();
  if ((apart + place).norm() < apart.norm()) laid.translation() = -place;
  return laid;
}

/// Which material a file holds goes by its name, as file_of_part() gives it.
core::WrittenMaterial material_of(const std::filesystem::path& file, const core::Body& body) {
  const std::string stem = file.stem().string();
  if (body.one_material() && body.void_density == 0) return {"part", body.density, file};
  if (stem.ends_with("-filling")) return {"filling", body.void_density, file};
  if (stem.ends_with("-interior")) return {"interior", body.interior_density, file};
  return {"part", body.density, file};
}

}  // namespace

Part part_of(const core::Design& design) {
  const core::RunResult& r = design.run;
  Part part;
  for (const core::MaterialPart& solid : design.part.solids) {
    part.meshes.push_back(core::joined(core::laid_surfaces(solid), solid.name));
    part.names.push_back(solid.name);
    part.densities.push_back(solid.density);
  }
  part.moments = r.model_moments(r.verified.moments);
  part.voids = r.voids.pieces.size();
  part.wall_mm = design.wall;
  part.thinnest = design.thinnest.thickness;
  part.verdict = r.verified.verdict;
  part.state = std::make_shared<const Part::State>(Part::State{design.part.solids});
  return part;
}

std::vector<std::filesystem::path> Part::write(const std::filesystem::path& file) const {
  if (!state) throw InputError("an empty part; expected one of Session::part");
  std::vector<std::filesystem::path> files;
  for (const core::WrittenMaterial& material : core::write_parts(file, state->solids))
    if (files.empty() || files.back() != material.file) files.push_back(material.file);
  return files;
}

Verdict verify(const std::vector<std::filesystem::path>& files, const Body& body, const Question& question) {
  if (files.empty()) throw InputError("no files to verify; expected those of a part");
  const core::RunConfig config = core::config_of(question);
  if (config.free || config.flatten)
    throw InputError("a part in a pose that is to be found; expected the question of its solution");
  const core::ProblemEntry& asked = core::find_problem(config.problem);
  const core::Body solid = core::make_body(asked.posed(config.body), *body.state_);
  const auto problem = asked.make(core::problem_settings(config), solid);
  std::vector<core::WrittenMaterial> materials;
  for (const std::filesystem::path& file : files) {
    const std::vector<core::TriangleMesh> meshes = core::read_objects(file);
    const std::size_t objects = meshes.size();
    if (objects > 1 && !(solid.one_material() && solid.void_density == 0))
      throw InputError(fmt::format("{}: {} objects of several materials; expected a file each, as STL",
                                   file.string(), objects));
    core::WrittenMaterial material = material_of(file, solid);
    material.laid = laid_of(meshes, solid);
    materials.insert(materials.end(), objects, material);
  }
  return core::verify_written(std::move(materials), solid, *problem).verdict;
}

}  // namespace kreisel
