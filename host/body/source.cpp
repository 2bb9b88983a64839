#include "body/source.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "body/models.hpp"
#include "body/models/debian_meshes.hpp"
#include "error.hpp"
#include "mesh/io/format.hpp"
#include "mesh/io/read.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/solid.hpp"
#include "nearest.hpp"

namespace kreisel::core {
namespace {

[[noreturn]] void unknown(const std::string& name) {
  const std::string meant = nearest(name, shape_names());
  throw InputError(fmt::format(
      "model '{}' is neither a known name nor a file{}; expected a name of `bench list`, or a mesh file",
      name, meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant)));
}

bool is_known(const std::string& model) { return find_model(model) || find_debian_mesh(model); }

bool is_name(const std::string& model) {
  std::error_code ignored;
  const std::filesystem::path path(model);
  return !path.has_extension() && !std::filesystem::exists(path, ignored);
}

/// Where the file is: as named, else in models_folder(). As named where it is in neither.
std::filesystem::path file_of(const std::string& model) {
  std::error_code ignored;
  const std::filesystem::path in_folder = models_folder() / model;
  const bool elsewhere =
      !std::filesystem::exists(model, ignored) && std::filesystem::exists(in_folder, ignored);
  return elsewhere ? in_folder : std::filesystem::path(model);
}

/// Only what has no unit of its own takes one.
void require_unit_wanted(const BodySpec& spec) {
  if (!spec.unit) return;
  const auto refuse = [&](const char* expected) {
    throw InputError(
        fmt::format("unit {} for model '{}'; expected {}", spec.unit->name, spec.model, expected));
  };
  if (is_known(spec.model)) refuse("none with the name of a model, which is in mm (size scales it)");
  if (mesh_format(spec.model).has_unit) refuse("none with a file that says what its lengths are in");
}

/// Only what is read from the user's file may have corners that differ by round-off; and what we make
/// ourselves needs no mending.
void require_mending_wanted(const BodySpec& spec) {
  if (find_model(spec.model) && spec.mending != Mending{.weld = spec.mending.weld})
    throw InputError(
        fmt::format("model '{}' is whole and of one piece; expected neither close-holes, inside-out nor "
                    "pieces with it",
                    spec.model));
  const std::optional<double>& weld = spec.mending.weld;
  if (!weld) return;
  if (!(*weld >= 0)) throw InputError(fmt::format("weld {} mm; expected >= 0", *weld));
  if (is_known(spec.model))
    throw InputError(
        fmt::format("weld {} mm for model '{}'; expected none with the name of a model", *weld, spec.model));
}

/// Millimetres in a unit of the mesh.
double scale_of(const Source& source, const TriangleMesh& mesh, std::optional<double> size) {
  if (!size) size = source.size;
  return size && !mesh.vertices.empty() ? *size / bounding_box(mesh).extent().maxCoeff() : source.millimetres;
}

}  // namespace

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const Model& m : models()) names.emplace_back(m.name);
  for (const DebianMesh& m : debian_meshes()) names.emplace_back(m.name);
  return names;
}

std::filesystem::path models_folder() {
  const char* given = std::getenv("KREISEL_MODELS");
  return given && *given ? given : "models";
}

bool is_absent_file(const std::string& model) {
  std::error_code ignored;
  return !is_known(model) && !is_name(model) && !std::filesystem::exists(file_of(model), ignored);
}

void require_known_source(const BodySpec& spec) {
  if (!is_known(spec.model) && is_name(spec.model)) unknown(spec.model);
  require_unit_wanted(spec);
  require_mending_wanted(spec);
}

void require_unit_said(const BodySpec& spec, const Source& solid) {
  constexpr double pea = 5, table = 1000;
  if (spec.unit || spec.size || is_known(spec.model) || mesh_format(spec.model).has_unit) return;
  const double longest = bounding_box(solid.mesh).extent().maxCoeff();
  if (longest >= pea && longest <= table) return;
  std::string sizes;
  for (const LengthUnit& unit : length_units())
    sizes +=
        fmt::format("{}{} ({:.4g} mm)", sizes.empty() ? "" : ", ", unit.name, longest * unit.millimetres);
  throw InputError(
      fmt::format("{} is {:.4g} at its longest and does not say in what unit; expected --unit {}, or --size "
                  "with its longest side in mm",
                  spec.model, longest, sizes));
}

Source load_source(const BodySpec& spec) {
  require_known_source(spec);
  if (const Model* model = find_model(spec.model)) {
    if (spec.fineness < 0)
      throw InputError(fmt::format("fineness {} of model '{}'; expected >= 1", spec.fineness, spec.model));
    return {.name = spec.model,
            .format = "parametric model",
            .mesh = model->make(spec.fineness ? spec.fineness : model->default_fineness),
            .ours = true,
            .axis = model->axis,
            .up = model->up,
            .contact = model->contact,
            .size = {}};
  }
  if (const DebianMesh* real = find_debian_mesh(spec.model))
    return {.name = spec.model,
            .format = "OFF, of Debian's libcgal-demo",
            .mesh = read_debian_mesh(*real),
            .axis = real->up,
            .up = real->up,
            .contact = {},
            .size = DebianMesh::size,
            .mending = spec.mending};
  const std::filesystem::path path = file_of(spec.model);
  MeshReading reading = read_mesh_file(path);
  const double millimetres = spec.unit ? spec.unit->millimetres : 1.0;
  return {.name = path.stem().string(),
          .format = std::string(mesh_format(path).name),
          .mesh = std::move(reading.mesh),
          .contact = {},
          .size = {},
          .millimetres = millimetres,
          .weld = spec.mending.weld ? *spec.mending.weld / millimetres : reading.weld,
          .mending = spec.mending,
          .repairs = std::move(reading.notes)};
}

Source load_solid(const BodySpec& spec) {
  Source source = load_source(spec);
  if (source.ours) {
    require_solid(source.mesh, spec.model);
    return source;
  }
  Surface surface = surface_of(source);
  source = as_solid(std::move(source), surface, spec.model);
  require_one_piece(source, spec.model, spec.size, spec.density);
  return source;
}

Surface surface_of(Source& source) {
  return Surface(std::move(source.mesh), source.weld, {std::move(source.repairs)});
}

Source as_solid(Source source, Surface& surface, const std::string& model) {
  const double unit = scale_of(source, surface.mesh(), {});
  SolidMesh solid = make_solid(surface, model, source.mending, unit);
  source.mesh = std::move(solid.mesh);
  source.repairs = std::move(solid.repairs.lines);
  source.pieces = std::move(solid.pieces);
  return source;
}

void require_one_piece(const Source& solid, const std::string& model, std::optional<double> size,
                       double density) {
  if (solid.pieces.size() < 2 || !solid.mending.pieces.empty()) return;
  const double unit = scale_of(solid, solid.mesh, size);
  constexpr std::size_t most = 5;
  std::string weights;
  for (std::size_t i = 0; i < std::min(most, solid.pieces.size()); ++i)
    weights += fmt::format("{}{} of {:.4g} g", i ? ", " : "", i + 1,
                           density * 1e-3 * solid.pieces[i].volume * unit * unit * unit);
  if (solid.pieces.size() > most) weights += ", ...";
  throw InputError(
      fmt::format("{}: {} pieces that do not touch, no rigid body: {}; expected one piece, or --pieces with "
                  "`largest` or the numbers of those that are meant",
                  model, solid.pieces.size(), weights));
}

}  // namespace kreisel::core
