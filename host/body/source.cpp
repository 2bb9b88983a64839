#include "body/source.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "body/models.hpp"
#include "body/models/debian_meshes.hpp"
#include "error.hpp"
#include "mesh/format.hpp"
#include "mesh/read.hpp"
#include "nearest.hpp"

namespace kreisel {
namespace {

[[noreturn]] void unknown(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Model& m : models()) names.push_back(m.name);
  for (const DebianMesh& m : debian_meshes()) names.push_back(m.name);
  const std::string meant = nearest(name, names);
  throw InputError(fmt::format(
      "model '{}' is neither a known name nor a file{}; expected a name of `bench list`, or a mesh file",
      name, meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant)));
}

bool is_name(const std::string& model) {
  std::error_code ignored;
  const std::filesystem::path path(model);
  return !path.has_extension() && !std::filesystem::exists(path, ignored);
}

}  // namespace

void require_known_model(const std::string& model) {
  if (!find_model(model) && !find_debian_mesh(model) && is_name(model)) unknown(model);
}

Source load_source(const BodySpec& spec) {
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
            .size = DebianMesh::size};
  require_known_model(spec.model);
  const std::filesystem::path path(spec.model);
  return {.name = path.stem().string(),
          .format = std::string(mesh_format(path).name),
          .mesh = read_mesh(path),
          .contact = {},
          .size = {}};
}

}  // namespace kreisel
