#include "apps/design/nest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/shared/completion.hpp"
#include "apps/shared/exit_code.hpp"
#include "apps/shared/step_line.hpp"
#include "body/source.hpp"
#include "design/page.hpp"
#include "file/write_text.hpp"
#include "words.hpp"

namespace kreisel::core::apps {
namespace {

void print(const Nested& nested) {
  const NestConfig& config = nested.spec.config;
  fmt::print("{}: {:.4g} mm, {:.4g} g/cm^3; walls of {:.3g} mm, {:.3g} mm of play\n", shapes_text(config),
             nested.size, nested.spec.density, nested.spec.layers().tolerances.wall,
             nested.spec.layers().tolerances.accuracy);
  for (const std::string& line : nested.repairs) fmt::print("  repaired   {}\n", line);
  if (!nested.feasible()) {
    fmt::print(
        "nothing written: {}\n  would help a thinner --wall, a finer --printer-accuracy or a larger --size\n",
        nested.text);
    return;
  }
  fmt::print("  layer  longest, mm  of the outer  certified   play, mm   wall, mm\n");
  for (std::size_t k = 0; k < nested.layers.size(); ++k) {
    const NestedLayer& layer = nested.layers[k];
    const nest::Layer& found = layer.found;
    fmt::print("  {:>5} {:>12.2f} {:>13.4f} {:>10} {:>10.3f} {:>10.3f}\n", k + 1, found.longest, found.ratio,
               found.certified_scale >= found.scale ? "yes" : "smaller", layer.gap, layer.wall);
  }
  fmt::print("  {:<20} {:>9} {:>7} {:>9}\n", "part", "triangles", "pieces", "mass, g");
  for (const NestedPart& part : nested.parts)
    fmt::print("  {:<20} {:>9} {:>7} {:>9.3f}  {}\n", part.written.name, part.written.triangles, part.shells,
               part.written.grams, part.written.file.string());
  fmt::print("  ended      {}\n", nested.ended);
  fmt::print("  took       {:.1f} s to search, {:.1f} s to carve, write and verify\n", nested.search_seconds,
             nested.parts_seconds);
  fmt::print("{}\n", nested.text);
}

}  // namespace

void add_nest_options(CLI::App& app, NestArguments& arguments) {
  offer(app.add_option("models", arguments.models,
                       "names of `bench list` or mesh files, the outermost first; the last goes into itself")
            ->type_name("NAME|FILE")
            ->required(),
        shape_names);
  arguments.outputs.add(app,
                        "the parts, each a file with a name of its own beside this one, or objects of it");
  app.option_defaults()->group("The parts");
  app.add_option("--wall", arguments.wall,
                 "least thickness of the wall: in mm, or in per cent of the longest side (2%)")
      ->capture_default_str();
  app.add_option("--density", arguments.spec.density, "density of the material, g/cm^3")
      ->capture_default_str();
  app.add_flag("--lay-flat", arguments.spec.lay_flat,
               "lay the parts beside each other, halves on their cuts");
  app.add_option("--pegs", arguments.spec.peg_radius,
                 "radius of loose pins that align the halves of each layer, mm; default: none")
      ->check(CLI::PositiveNumber);
  app.add_flag("--accept", arguments.accept,
               "end with exit code 0, even if a wall or gap is less than was asked");
  app.add_option_function<std::string>(
      "--size", [&](const std::string& text) { arguments.options.say("outer-size", text); },
      "longest side of the outer shape, mm; default: as the model is");
  offer(app.add_option_function<std::string>(
            "--unit", [&](const std::string& text) { arguments.spec.unit = find_length_unit(text); },
            "unit of the outer shape, an STL, OBJ, PLY or OFF file: mm, cm, m or in; default mm"),
        names_in(length_units));
  arguments.options.add_some(app, {&find_run_kind("layers")},
                             {"layers", "printer-accuracy", "free", "up", "plane", "removal", "keep-out",
                              "fineness", "particles", "iterations", "seed", "seconds", "cells", "device"});
  app.footer(
      "Examples:\n"
      "  design nest bunny.stl -o doll.3mf --layers 2 --html doll.html    a bunny in a bunny in a bunny\n"
      "  design nest heart.stl duck.stl -o doll.stl --size 120 --lay-flat  a duck in a heart of 120 mm\n"
      "Lengths are mm, masses g, densities g/cm^3.");
}

int nest_parts(NestArguments& arguments) {
  NestedSpec& spec = arguments.spec;
  const std::vector<std::string>& models = arguments.models;
  GivenFields given = {{"outer", models.front()},
                       {"free", "all"},
                       {"layers", fmt::format("{}", std::max<std::size_t>(2, models.size()) - 1)},
                       {"printer-accuracy", "0.4"}};
  if (models.size() > 1) given.emplace_back("inner", models[1]);
  if (models.size() > 2) given.emplace_back("within", joined_words({models.begin() + 2, models.end()}));
  for (const GivenText& field : arguments.options.given()) given.emplace_back(field.name, field.text);
  spec.config = make_nest(given);
  spec.wall = parse_wall(arguments.wall);
  spec.file = arguments.outputs.part;
  arguments.outputs.require_writable();
  require_new(file_of_part(spec.file, "innermost"), "--output", arguments.outputs.force);
  const std::string three = arguments.outputs.html.empty() ? "" : installed_three();
  const Nested nested = [&] {
    const StepLine line;
    return make_nested(spec, line.control());
  }();
  if (!arguments.outputs.html.empty() && nested.feasible())
    write_text(arguments.outputs.html, page_of(nested, three));
  if (arguments.outputs.write_report(to_json(nested))) print(nested);
  if (!nested.feasible()) return infeasible;
  return nested.ok || arguments.accept ? done : not_as_asked;
}

}  // namespace kreisel::core::apps
