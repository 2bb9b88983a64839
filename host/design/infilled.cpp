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

WrittenPart write_infilled(const std::filesystem::path& file, const std::vector<PrintPiece>& pieces,
                           const MeshSlicer& slicer, threemf::Dialect dialect, const SolvedRun& run) {
  const Body& body = run.body();
  WrittenPart part;
  part.moments = body.added;
  std::string wrong;
  for (const PrintPiece& piece : pieces) {
    const std::filesystem::path path = file_of_piece(file, piece.name);
    const std::string name = path.empty() ? "the part" : path.string();
    const threemf::Project project = slicer.project(piece.filled(), piece.up, dialect);
    const Eigen::Isometry3d& to_bed = project.to_bed;
    const std::string bytes = encode_project(project, dialect, name);
    if (!path.empty()) write_text(path, bytes);
    const std::vector<threemf::Volume> read = threemf::read_project({name, bytes});
    if (read.size() != project.volumes.size() || read.front().modifier)
      throw InputError(fmt::format("{}: {} volumes, expected {}", name, read.size(), project.volumes.size()));
    const std::size_t outer = part.materials.size();
    for (std::size_t i = 0; i < read.size(); ++i) {
      const TriangleMesh mesh = moved(read[i].mesh, to_bed.inverse());
      try {
        require_sound(mesh, name);
      } catch (const InputError& error) {
        if (wrong.empty()) wrong = fmt::format("the written mesh is not a solid: {}", error.what());
      }
      const double density = i == 0 ? piece.density : piece.sparse_density;
      WrittenMaterial material{i == 0 ? "part" : "filling", density, path, mesh.triangles.size(), 0, {}};
      material.laid = to_bed;
      const Moments own = mass_of(mesh, density, body);
      material.grams = own[S1] * body.mass_grams();
      part.moments += own;
      part.materials.push_back(std::move(material));
      if (i == 0) continue;
      const Moments full =
          mass_of(mesh, body.density, body);  // the sparse region is taken out of what is full
      part.moments -= full;
      part.materials[outer].grams -= full[S1] * body.mass_grams();
    }
  }
  if (wrong.empty())
    part.verdict = run.problem().verify_at_rest(part.moments, body.frame.length);
  else
    part.verdict.text = wrong;
  return part;
}

}  // namespace kreisel::core
