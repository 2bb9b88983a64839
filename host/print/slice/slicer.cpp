#include "print/slice/slicer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "error.hpp"
#include "geometry/box.hpp"
#include "parse.hpp"
#include "program/run_program.hpp"
#include "words.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prusa_profile = R"(
layer_height = 0.2
first_layer_height = 0.2
nozzle_diameter = 0.4
filament_diameter = 1.75
perimeters = 2
fill_density = 100%
fill_pattern = rectilinear
skirts = 0
support_material = 1
support_material_auto = 1
support_material_buildplate_only = 1
bed_shape = 0x0,250x0,250x210,0x210
max_print_height = 210
gcode_label_objects = 1
)";

constexpr std::string_view cura_profile = R"(
layer_height = 0.2
layer_height_0 = 0.2
machine_nozzle_size = 0.4
line_width = 0.4
wall_line_count = 2
material_diameter = 1.75
infill_sparse_density = 100
infill_line_distance = 0.4
infill_pattern = lines
top_layers = 0
bottom_layers = 0
adhesion_type = none
support_enable = true
support_type = buildplate
machine_width = 250
machine_depth = 210
machine_height = 210
machine_center_is_zero = true
)";

/// Where Debian's package cura puts what cura-engine needs to know of machines.
constexpr const char* cura_definitions = "/usr/share/cura/resources/definitions";
constexpr const char* cura_machine = "fdmprinter.def.json";

struct Known {
  std::string_view names, package;  ///< of the program, in lower case; Debian's
  std::string_view profile;
};
constexpr Known prusa{"prusa-slicer superslicer", "prusa-slicer", prusa_profile},
    cura{"cura-engine curaengine", "cura-engine", cura_profile};

bool goes_by(const Known& known, const std::string& program) {
  std::string name = fs::path(program).filename().string();
  std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  const auto names = split_words(known.names);
  return std::ranges::find(names, name) != names.end();
}

/// CuraEngine is cura-engine to Debian's packages alone.
std::string program_of(const Known& known, const std::string& program) {
  for (const std::string& name : {program, std::string("CuraEngine")})
    if (is_program(name) && goes_by(known, name)) return name;
  throw InputError(
      fmt::format("--slicer {}: no such program, expected it installed (apt-get install {}), or its file",
                  program, known.package));
}

fs::path machine_definition() {
  std::string folders = cura_definitions;
  if (const char* given = std::getenv("CURA_ENGINE_SEARCH_PATH"))
    folders = fmt::format("{}:{}", given, folders);
  std::string_view rest = folders;
  while (!rest.empty()) {
    const fs::path file = fs::path(rest.substr(0, rest.find(':'))) / cura_machine;
    std::error_code ignored;
    if (fs::exists(file, ignored)) return file;
    rest = rest.find(':') == std::string_view::npos ? std::string_view{} : rest.substr(rest.find(':') + 1);
  }
  throw InputError(
      fmt::format("{}: not found, which CuraEngine needs; expected the package cura (apt-get install cura), "
                  "or its folder in CURA_ENGINE_SEARCH_PATH",
                  cura_machine));
}

std::string replaced(std::string word, std::string_view what, const std::string& by) {
  for (std::size_t at = 0; (at = word.find(what, at)) != std::string::npos; at += by.size())
    word.replace(at, what.size(), by);
  return word;
}

}  // namespace

Slicer::Slicer(const std::string& command) : command_(split_words(command)) {
  if (command_.empty())
    throw InputError("--slicer without a program, expected prusa-slicer, cura-engine or a command");
  const Known* const known = command_.size() > 1                ? nullptr
                             : goes_by(prusa, command_.front()) ? &prusa
                             : goes_by(cura, command_.front())  ? &cura
                                                                : nullptr;
  manner_ = known == &prusa ? Manner::prusa : known == &cura ? Manner::cura : Manner::command;
  if (known) {
    program_ = program_of(*known, command_.front());
    usual_ = parse_profile(known->profile, program_);
    return;
  }
  program_ = command_.front();
  for (const char* place : {"{model}", "{gcode}"})
    if (command.find(place) == std::string::npos)
      throw InputError(
          fmt::format("--slicer {}: no {} in it, expected prusa-slicer, cura-engine, or a command with "
                      "{{model}} and {{gcode}} where its files go",
                      command, place));
  if (!is_program(program_))
    throw InputError(
        fmt::format("--slicer {}: no such program, expected one that is installed, or its file", program_));
}

SlicerSettings Slicer::usual_on(const Printer& printer) const {
  const double nozzle = printer.nozzles.front();
  double layer = nozzle / 2;
  if (printer.most_layer > 0) layer = std::clamp(layer, printer.least_layer, printer.most_layer);
  const Vec3 size = printer.box().extent();
  const auto text = [](double number) { return fmt::format("{:.6g}", number); };
  switch (manner_) {
    case Manner::prusa:
      return {{"bed_shape", printer.bed_text()},
              {"max_print_height", text(printer.height)},
              {"nozzle_diameter", text(nozzle)},
              {"layer_height", text(layer)},
              {"first_layer_height", text(layer)}};
    case Manner::cura:
      return {{"machine_width", text(size[0])},  {"machine_depth", text(size[1])},
              {"machine_height", text(size[2])}, {"machine_nozzle_size", text(nozzle)},
              {"line_width", text(nozzle)},      {"infill_line_distance", text(nozzle)},
              {"layer_height", text(layer)},     {"layer_height_0", text(layer)}};
    case Manner::command:
      break;
  }
  return {};
}

SlicerSettings Slicer::supports_everywhere() const {
  switch (manner_) {
    case Manner::prusa:
      return {{"support_material", "1"},
              {"support_material_auto", "1"},
              {"support_material_buildplate_only", "0"}};
    case Manner::cura:
      return {{"support_enable", "true"}, {"support_type", "everywhere"}};
    case Manner::command:
      break;
  }
  return {};
}

Vec3 Slicer::middle(const SlicerSettings& settings) const {
  if (manner_ == Manner::cura) return Vec3::Zero();
  const auto shape = settings.find("bed_shape");  // "0x0,250x0,250x210,0x210"
  BoxOf<2> bed;
  if (shape != settings.end()) {
    std::string_view rest = shape->second;
    while (!rest.empty()) {
      const std::string_view corner = rest.substr(0, rest.find(','));
      const std::size_t times = corner.find('x');
      const auto x = parse<double>(corner.substr(0, times));
      const auto y = times == std::string_view::npos ? std::nullopt : parse<double>(corner.substr(times + 1));
      if (!x || !y)
        throw InputError(fmt::format("bed_shape = {}, expected corners XxY,XxY,...", shape->second));
      bed.add({*x, *y});
      rest = corner.size() == rest.size() ? std::string_view{} : rest.substr(corner.size() + 1);
    }
  }
  constexpr double usual = 100;  // PrusaSlicer's own
  return bed.hi[0] >= bed.lo[0] ? Vec3(bed.centre()[0], bed.centre()[1], 0) : Vec3(usual, usual, 0);
}

double Slicer::diameter(const SlicerSettings& settings) const {
  const auto said = settings.find("material_diameter");
  return said == settings.end() ? 0 : parse<double>(said->second).value_or(0);
}

std::vector<std::string> Slicer::words(const SlicerCall& call) const {
  switch (manner_) {
    case Manner::prusa:
      return {program_,   "--export-gcode",    "--dont-arrange",   "--load", call.profile.string(),
              "--output", call.gcode.string(), call.model.string()};
    case Manner::cura: {
      std::vector<std::string> words = {program_, "slice", "-j", machine_definition().string()};
      const auto set = [&] {
        for (const auto& [key, value] : call.settings)
          words.insert(words.end(), {"-s", fmt::format("{}={}", key, value)});
      };
      set();
      words.emplace_back("-e0");  // of the machine, then of its extruder
      set();
      words.insert(words.end(), {"-o", call.gcode.string(), "-l", call.model.string()});
      return words;
    }
    case Manner::command:
      break;
  }
  std::vector<std::string> words = command_;
  for (std::string& word : words)
    word = replaced(replaced(replaced(word, "{model}", call.model.string()), "{gcode}", call.gcode.string()),
                    "{profile}", call.profile.string());
  return words;
}

}  // namespace kreisel::core
