#include "live/solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "error.hpp"
#include "mesh/io/format.hpp"
#include "mesh/solid/check.hpp"
#include "nearest.hpp"

namespace kreisel::core::live {
namespace {

std::string name_of(const BodySpec& given) { return std::filesystem::path(given.model).filename().string(); }

Opened opened(BodySpec spec, Source mesh) {
  return {std::move(spec), std::make_shared<const Source>(std::move(mesh)), nullptr};
}

}  // namespace

std::string first_of(const Setup& setup) { return setup.given ? name_of(*setup.given) : ""; }

std::vector<std::string> names_of(const Setup& setup) {
  std::vector<std::string> names = shape_names();
  if (setup.given && std::ranges::find(names, name_of(*setup.given)) == names.end())
    names.insert(names.begin(), name_of(*setup.given));
  return names;
}

Opened open_named(const Setup& setup, const std::string& name, const BodySpec& said) {
  if (setup.given && name == name_of(*setup.given)) return opened(*setup.given, load_source(*setup.given));
  const std::vector<std::string> names = names_of(setup);
  if (std::ranges::find(names, name) == names.end()) {
    const std::string meant = nearest(name, names);
    throw InputError(fmt::format("model '{}'; expected a known name{}, or a mesh that is sent", name,
                                 meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant)));
  }
  BodySpec spec = said;
  spec.model = name;
  return opened(spec, load_source(spec));
}

Opened open_sent(const Setup& setup, const std::string& name, std::string bytes, const BodySpec& said) {
  if (bytes.empty()) throw InputError(fmt::format("{}: empty file, expected a mesh", name));
  const MeshFormat& format = mesh_format(name);
  MeshReading reading = format.read({name, std::move(bytes)});
  const std::size_t triangles = reading.mesh.triangles.size();
  if (triangles == 0) throw InputError(fmt::format("{}: no triangles, expected at least one face", name));
  if (triangles > setup.limits.triangles)
    throw InputError(
        fmt::format("{}: {} triangles; expected at most {} here", name, triangles, setup.limits.triangles));
  if (said.unit && format.has_unit)
    throw InputError(fmt::format("unit {} for {}, which says what its lengths are in; expected none",
                                 said.unit->name, name));
  const double millimetres = said.unit ? said.unit->millimetres : 1.0;
  BodySpec spec = said;
  spec.model = name;
  return opened(spec, {.name = std::filesystem::path(name).stem().string(),
                       .format = std::string(format.name),
                       .mesh = std::move(reading.mesh),
                       .contact = {},
                       .size = {},
                       .millimetres = millimetres,
                       .weld = said.mending.weld ? *said.mending.weld / millimetres : reading.weld,
                       .mending = said.mending,
                       .repairs = std::move(reading.notes)});
}

void make_solid(Opened& opened) {
  Source source = *opened.mesh;
  if (source.ours) {
    require_solid(source.mesh, opened.spec.model);
  } else {
    Surface surface = surface_of(source);
    source = as_solid(std::move(source), surface, opened.spec.model);
    require_one_piece(source, opened.spec.model, opened.spec.size, opened.spec.density);
  }
  require_unit_said(opened.spec, source);
  opened.solid = std::make_shared<const Source>(std::move(source));
}

}  // namespace kreisel::core::live
