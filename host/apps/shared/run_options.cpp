#include "apps/shared/run_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"

namespace kreisel::core::apps {
namespace {

struct FieldOption {
  const char *option, *field, *help;
};

/// Fields of a run that have an option of their own.
constexpr FieldOption fields[] = {
    {"model", "model", "a name of `bench list`, or a mesh file (STL, 3MF, OBJ, PLY, OFF); default ellipsoid"},
    {"problem", "problem", "what is asked; default spin"},
    {"formulation", "formulation", "how the interior is described; default rayrep"},
    {"solver", "solver", "default: ipopt, for quadric moment"},
    {"domain", "domain",
     "columns (whole cells) or exact (cut at the wall); default columns, for quadric exact"},
    {"resolution", "resolution", "cells along the longest side, or NXxNYxNZ; default 64"},
    {"level", "level", "of an octree: 2^level cells along the longest side"},
    {"wall", "wall", "least wall: 1.5h (cells), 2% (of the longest side) or mm; default 1.5h"},
    {"rounding", "rounding",
     "of the written part: nearest, or fitted so that the constraints hold (default)"},
    {"part", "part", "written (default), or none: the run ends with the solve"},
    {"axis", "axis",
     "spin axis x,y,z in model coordinates, auto (the best), or near:x,y,z (within 30 degrees); default up"},
    {"through", "axis-through",
     "where such an axis runs: lowest (point along it) or centre (of mass, on a stem); default lowest, else "
     "centre"},
    {"stem", "stem", "radius of a peg to spin on, along the axis down to the lowest point's height, mm"},
    {"tip", "tip", "R[,H]: radius and height of the cone at its end, mm; default the stem's radius"},
    {"contact", "contact",
     "a point of the axis, mm; default the lowest along it, for yoyo the centre of mass"},
    {"up", "up",
     "up direction x,y,z, auto (the best pose), near:x,y,z, or rest:N (the N-th most probable); default the "
     "model's, else 0,0,1"},
    {"flatten", "flatten", "cut that much off the bottom, mm; auto: the least that makes a base"},
    {"unit", "unit", "of an STL, OBJ, PLY or OFF file: mm, cm, m or in; default mm"},
    {"weld", "weld", "corners at open edges of a file this near are one, mm; default as its digits say"},
    {"size", "size", "longest side in mm; default as the model is"},
    {"density", "density", "of the shell, g/cm^3; default 1"},
    {"interior-density", "interior-density", "of what is left of the interior, g/cm^3; default the shell's"},
    {"void-density", "void-density", "of what fills the voids, g/cm^3; default 0"},
    {"axle", "axle", "yoyo: radius of an axle between two halves, mm; default none, the body stays whole"},
    {"slot", "slot", "yoyo: gap between the halves, mm; default the axle's radius"},
    {"axle-depth", "axle-depth", "yoyo: of the hole for the axle in each half, mm; default twice its radius"},
    {"fineness", "fineness", "of a parametric model: about 20 n^2 triangles"},
    {"device", "device", "index or part of a name; default KREISEL_DEVICE, else a GPU, else PoCL"},
    {"precision", "precision", "automatic or single (compensated)"},
    {"repeat", "repeat", "timed solves at most; default 1"},
    {"budget", "budget", "seconds after which no further repetition starts; default 20"},
    {"target", "problem.target", "stand: centre, inside or max-tilt; default centre, of design max-tilt"},
    {"lower", "problem.lower", "top: mass, height or none, beside the inertia ratio; default mass"},
    {"draft", "problem.draft", "float: 60% of the height, mm, grams (40g), solid, or auto; default 60%"},
    {"fluid-density", "problem.fluid_density", "float: g/cm^3; default 1"},
    {"point", "problem.point",
     "balance: where the centre of mass is to be, x,y,z in mm; hang: from where, default the highest point"},
    {"line", "problem.line", "balance: direction of a line through that point; hang: which way is up"},
};

}  // namespace

void RunOptions::add(CLI::App& app, const std::string& option, const std::string& field,
                     const std::string& help) {
  app.add_option_function<std::string>(
      option, [this, field](const std::string& text) { say(field, text); }, help);
}

void RunOptions::add(CLI::App& app, std::initializer_list<std::string_view> some) {
  const bool all = some.size() == 0;
  for (const auto& [option, field, help] : fields) {
    if (!all && std::ranges::find(some, std::string_view(field)) == some.end()) continue;
    const bool model = !all && field == std::string_view("model");
    add(app, model ? "model,--model" : fmt::format("--{}", option), field, help);
    if (model) app.get_option("--model")->required();
  }
}

void RunOptions::add_settings(CLI::App& app, const std::string& help) {
  app.add_option("--set", settings_, help)->allow_extra_args(false)->type_name("GROUP.NAME=VALUE");
}

void RunOptions::apply(RunConfig& config) const {
  for (const auto& [field, text] : given_) set_field(config, field, text);
  for (const std::string& setting : settings_) {
    const auto equals = setting.find('=');
    const auto dot = setting.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot > equals)
      throw InputError(fmt::format("--set {}; expected GROUP.NAME=VALUE", setting));
    set_field(config, setting.substr(0, equals), setting.substr(equals + 1));
  }
}

}  // namespace kreisel::core::apps
