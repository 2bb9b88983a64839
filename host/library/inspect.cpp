#include "session/inspect.hpp"

#include "library/state.hpp"

namespace kreisel {

Inspection inspect(const std::filesystem::path& file, double mm_per_unit, double density,
                   const Mending& mending) {
  return translated([&] {
    core::BodySpec spec;
    spec.model = file.string();
    spec.density = density;
    return core::inspect(core::read_source(file, mm_per_unit, mending), spec);
  });
}

Inspection inspect(Mesh mesh, double density, const Mending& mending) {
  return translated([&] {
    core::BodySpec spec;
    spec.model = "mesh";
    spec.density = density;
    return core::inspect(core::source_of(std::move(mesh), mending), spec);
  });
}

}  // namespace kreisel
