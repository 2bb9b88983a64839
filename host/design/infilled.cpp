#include "design/infilled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "geometry/moved.hpp"
#include "mesh/solid/solid.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {
namespace {

/// Mass of a solid at that density, body frame and units.
Moments mass_of(const TriangleMesh& model, double density, const Body& body) {
  return density / body.density * reference::mesh_moments(to_body(body.frame, model)).value;
}

}  // namespace

Filled filled_of(const std::vector<MaterialPart>& solids) {
  const MaterialPart& part = solids.front();
  Filled filled{part.surfaces.front(), {}, part.place};
  if (solids.size() > 1) filled.sparse = solids[1].surfaces.front();
  return filled;
}

double area_of(const TriangleMesh& mesh) {
  double twice = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    twice += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  return twice / 2;
}

InfillUse use_infill(Session& session, RunConfig& config, const InfillDensity& density, const Infill& infill,
                     const PartOptions& options, const Control& control) {
  InfillUse use{infill, density};
  const auto set = [&](const TriangleMesh& region) {
    use.volume = std::abs(reference::mesh_moments(region).value[S1]);
    use.surface = area_of(region);
    use.share = std::min(density.share(use.volume, use.surface), 0.99);
    config.body.void_density = use.share * config.body.density;
  };
  // Less of a body than all of it has more boundary for its volume; the next part is made of what this one
  // says.
  set(SolvedRun(session, config, control).body().mesh);
  SolvedRun run(session, config, control);
  run.solve(control);
  if (run.result.outcome.termination == Termination::infeasible) return use;
  const PartMeshes ahead = make_part(run, "", options);
  if (!ahead.cavity.triangles.empty()) set(ahead.cavity);
  return use;
}

WrittenPart write_infilled(const std::filesystem::path& file, const std::vector<MaterialPart>& solids,
                           const Infill& infill, threemf::Dialect dialect, const Eigen::Isometry3d& to_bed,
                           const SolvedRun& run) {
  const Body& body = run.body();
  const std::string name = file.empty() ? "the part" : file.string();
  const threemf::Project project = project_of(filled_of(solids), infill, dialect, to_bed);
  const std::string bytes = encode_project(project, dialect, name);
  if (!file.empty()) write_text(file, bytes);
  const std::vector<threemf::Volume> read = threemf::read_project({name, bytes});
  WrittenPart part;
  std::string wrong;
  if (read.size() != project.volumes.size() || read.front().modifier)
    throw InputError(fmt::format("{}: {} volumes, expected {}", name, read.size(), project.volumes.size()));
  Moments full = Moments::Zero();
  for (std::size_t i = 0; i < read.size(); ++i) {
    const TriangleMesh mesh = moved(read[i].mesh, to_bed.inverse());
    try {
      require_sound(mesh, name);
    } catch (const InputError& error) {
      if (wrong.empty()) wrong = fmt::format("the written mesh is not a solid: {}", error.what());
    }
    WrittenMaterial material{solids[i].name, solids[i].density, file, mesh.triangles.size(), 0, {}};
    material.laid = to_bed;
    const Moments own = mass_of(mesh, material.density, body);
    material.grams = own[S1] * body.mass_grams();
    part.moments += own;
    if (i > 0) full += mass_of(mesh, body.density, body);
    part.materials.push_back(std::move(material));
  }
  part.materials.front().grams -= full[S1] * body.mass_grams();  // the sparse region is taken out of it
  part.moments += body.added - full;
  if (wrong.empty())
    part.verdict = run.problem().verify_at_rest(part.moments, body.frame.length);
  else
    part.verdict.text = wrong;
  return part;
}

}  // namespace kreisel::core
