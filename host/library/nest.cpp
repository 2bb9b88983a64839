#include "kreisel/nest.hpp"

#include "library/state.hpp"
#include "run/nest_run.hpp"

namespace kreisel {

Nesting nest(const Mesh& outer, const Mesh& inner, const std::map<std::string, std::string>& fields,
             const std::function<bool(int, double)>& on_iteration, const Control& control) {
  for (const char* name : {"outer", "inner", "within"})
    if (fields.contains(name))
      throw InputError(std::string("nest: ") + name + " = '" + fields.at(name) +
                       "'; expected none, the meshes are given");
  core::NestConfig config = core::make_nest({fields.begin(), fields.end()});
  if (!core::part_of<core::NestPlace>(config))
    throw InputError("nest: layers, landscape or accuracy; expected a test, a scale or a search");
  config.outer = "outer";  // in words, of the meshes below
  config.inner = "inner";
  core::NestHooks hooks;
  hooks.control = control;
  hooks.shapes = {outer, inner};
  if (on_iteration)
    hooks.on_iteration = [&](const core::nest::SearchState& state) {
      return on_iteration(static_cast<int>(state.trace.size()), state.scale);
    };
  const core::NestResult found = translated([&] { return core::run_nest(config, hooks); });
  control.stop_if_asked();
  Nesting nesting;
  nesting.valid = found.valid;
  nesting.scale = found.scale;
  nesting.certified_scale = found.certified ? found.certified->scale : 0;
  nesting.transform = found.transform;
  nesting.plane_point = found.plane_point;
  nesting.plane_normal = found.plane_normal;
  nesting.plus = found.plus;
  nesting.minus = found.minus;
  nesting.text = found.text;
  nesting.seconds = found.setup_seconds + found.search_seconds + found.certify_seconds;
  return nesting;
}

}  // namespace kreisel
