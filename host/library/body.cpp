#include <fmt/format.h>

#include <cmath>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "geometry/moved.hpp"
#include "library/state.hpp"
#include "mesh/io/format.hpp"
#include "mesh/io/read.hpp"

namespace kreisel {
Body::Body(std::shared_ptr<const State> state) : state_(std::move(state)) {}

core::Source core::read_source(const std::filesystem::path& file, double mm_per_unit,
                               const Mending& mending) {
  if (!(mm_per_unit > 0) || !std::isfinite(mm_per_unit))
    throw InputError(fmt::format("{} mm a unit of {}; expected > 0", mm_per_unit, file.string()));
  if (mm_per_unit != 1 && mesh_format(file).has_unit)
    throw InputError(fmt::format("{} mm a unit of {}, which says itself what its lengths are in; expected 1",
                                 mm_per_unit, file.string()));
  if (mending.weld && !(*mending.weld >= 0))
    throw InputError(fmt::format("weld {} mm; expected >= 0", *mending.weld));
  MeshReading reading = read_mesh_file(file);
  for (Vec3& v : reading.mesh.vertices) v *= mm_per_unit;
  return {.name = file.stem().string(),
          .format = std::string(mesh_format(file).name),
          .mesh = std::move(reading.mesh),
          .contact = {},
          .size = {},
          .weld = mending.weld.value_or(mm_per_unit * reading.weld),
          .mending = mending,
          .repairs = std::move(reading.notes)};
}

core::Source core::source_of(Mesh mesh, const Mending& mending) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= mesh.vertices.size())
        throw InputError(fmt::format("a triangle of the vertex {}; expected one of {}, counted from 0", v,
                                     mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      throw InputError(fmt::format("vertex {} is not finite; expected three numbers", i));
  if (mesh.triangles.empty()) throw InputError("a mesh without triangles; expected a closed surface");
  return {.name = "mesh",
          .format = "in memory",
          .mesh = std::move(mesh),
          .contact = {},
          .size = {},
          .mending = mending};
}

namespace {

core::Source solid_of(core::Source source, const std::string& name) {
  core::Surface surface = core::surface_of(source);
  source = core::as_solid(std::move(source), surface, name);
  core::require_one_piece(source, name, {}, 1);
  return source;
}

}  // namespace

Body Body::read(const std::filesystem::path& file, double mm_per_unit, const Mending& mending) {
  return Body(std::make_shared<const State>(
      State{solid_of(core::read_source(file, mm_per_unit, mending), file.string())}));
}

Body Body::model(const std::string& name) {
  core::BodySpec spec;
  spec.model = name;
  core::Source source = core::load_solid(spec);
  // As `bench` has it: a model of the real world comes in its printed size.
  if (source.size) {
    const double scale = *source.size / core::bounding_box(source.mesh).extent().maxCoeff();
    for (Vec3& v : source.mesh.vertices) v *= scale;
    source.size.reset();
  }
  return Body(std::make_shared<const State>(State{std::move(source)}));
}

Body::Body(Mesh mesh, const Mending& mending)
    : state_(
          std::make_shared<const State>(State{solid_of(core::source_of(std::move(mesh), mending), "mesh")})) {
}

const Mesh& Body::mesh() const { return state_->mesh; }

Moments Body::moments() const {
  // About the middle first: about an origin far away their digits would be those of the distance.
  const Vec3 middle = core::bounding_box(state_->mesh).centre();
  const core::TriangleMesh near = core::moved(state_->mesh, Eigen::Translation3d(-middle));
  return core::transformed(core::reference::mesh_moments(near).value, Eigen::Matrix3d::Identity(), middle);
}

const std::vector<std::string>& Body::repairs() const { return state_->repairs; }

}  // namespace kreisel
