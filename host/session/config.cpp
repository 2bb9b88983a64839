#include "session/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <vector>

#include "error.hpp"
#include "formulation/formulation.hpp"
#include "parse.hpp"
#include "problem/problem.hpp"
#include "session/field_names.hpp"
#include "session/field_text.hpp"
#include "solve/solver.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

constexpr std::array<std::string_view, 6> groups = {"ipopt",   "moment",      "slsqp",
                                                    "problem", "formulation", "solver"};

GridSpec grid(std::string_view key, std::string_view value) {
  GridSpec spec;
  std::vector<int> cells;
  for (const std::string_view part : split(value, 'x')) cells.push_back(parse<int>(part).value_or(-1));
  if (cells.size() == 1 && cells[0] >= 2)
    spec.resolution = cells[0];
  else if (cells.size() == 3 && std::ranges::min(cells) >= 2)
    spec.cells = {cells[0], cells[1], cells[2]};
  else
    refuse(key, value, "cells along the longest side (2 to 1024), or NXxNYxNZ");
  return spec;
}

/// Levels that are too many are refused by the grid, with the memory that they would need.
GridSpec grid_of_level(std::string_view key, std::string_view value) {
  constexpr int most = 20;
  const int level = parse<int>(value).value_or(-1);
  if (level < 1 || level > most) refuse(key, value, "1 to 10: 2^level cells along the longest side");
  GridSpec spec;
  spec.resolution = 1 << level;
  return spec;
}

std::string text_of(const GridSpec& spec) {
  return spec.cells ? fmt::format("{}", fmt::join(*spec.cells, "x")) : std::to_string(spec.resolution);
}

bool is_setting(std::string_view key) {
  for (const std::string_view group : groups)
    if (key.size() > group.size() + 1 && key.starts_with(group) && key[group.size()] == '.') return true;
  return false;
}

MapConfig& map_of(RunConfig& config) {
  if (!config.map) {
    config.map.emplace();
    config.formulation = "quadric";
  }
  return *config.map;
}

using Setter = std::function<void(RunConfig&, std::string_view key, std::string_view value)>;

using Setters = std::map<std::string_view, Setter>;
using C = RunConfig&;
using S = std::string_view;

FreePose& free_pose_of(RunConfig& config) { return config.free ? *config.free : config.free.emplace(); }

/// A direction, or how one is to be found. @param rests  by the number of a way of lying, too
void set_direction(RunConfig& config, std::optional<Vec3>& direction, S key, S value, bool rests) {
  constexpr S near = "near:", rest = "rest:";
  const auto begin = [&](std::optional<Vec3> to, std::optional<int> number) {
    direction.reset();
    FreePose& free = free_pose_of(config);
    free.near = std::move(to);
    free.rest = number;
  };
  if (value == "auto") return begin({}, {});
  if (value.starts_with(near)) {
    const Vec3 to = vector(key, value.substr(near.size()));
    if (!to.allFinite() || to.norm() == 0) refuse(key, value, "near: and a direction other than zero");
    return begin(to, {});
  }
  if (rests && value.starts_with(rest)) return begin({}, whole(key, value.substr(rest.size()), 1));
  if (!parse_vector(value))
    refuse(key, value, rests ? "x,y,z, auto, near:x,y,z or rest:N" : "x,y,z, auto or near:x,y,z");
  direction = vector(key, value);
  if (!config.free) return;
  if (config.free->through)  // of an axis that is given
    config.free->near = {}, config.free->rest = {};
  else
    config.free.reset();
}

/// Shapes that are made along the axis: what is joined, what is cut off.
Setters shape_setters() {
  return {
      {"stem", [](C c, S k, S v) { c.body.stem.radius = number(k, v); }},
      {"tip",
       [](C c, S k, S v) {
         const auto parts = split(v, ',');
         if (parts.size() > 2) refuse(k, v, "a radius, or a radius and a height R,H in mm");
         c.body.stem.tip_radius = number(k, parts[0]);
         c.body.stem.tip_height.reset();
         if (parts.size() == 2) c.body.stem.tip_height = number(k, parts[1]);
       }},
      {"flatten",
       [](C c, S k, S v) {
         c.flatten = v == "auto";
         c.body.flatten.reset();
         if (!c.flatten && !parse<double>(v)) refuse(k, v, "mm, or auto");
         if (!c.flatten) c.body.flatten = number(k, v);
       }},
      {"axis-through",
       [](C c, S k, S v) {
         if (v != "lowest" && v != "centre") refuse(k, v, "lowest or centre");
         free_pose_of(c).through = v == "centre" ? Through::centre : Through::lowest;
       }},
  };
}

/// What the body is, and how it lies.
Setters body_setters() {
  return {
      {"model", [](C c, S, S v) { c.body.model = v; }},
      {"axis", [](C c, S k, S v) { set_direction(c, c.body.axis, k, v, false); }},
      {"up", [](C c, S k, S v) { set_direction(c, c.body.up, k, v, true); }},
      {"contact", [](C c, S k, S v) { c.body.contact = vector(k, v); }},
      {"unit", [](C c, S, S v) { c.body.unit = find_length_unit(v); }},
      {"weld",
       [](C c, S k, S v) {
         c.body.weld = number(k, v);
         if (*c.body.weld < 0) refuse(k, v, "0 mm or more");
       }},
      {"size", [](C c, S k, S v) { c.body.size = number(k, v); }},
      {"density", [](C c, S k, S v) { c.body.density = number(k, v); }},
      {"interior-density", [](C c, S k, S v) { c.body.interior_density = number(k, v); }},
      {"void-density", [](C c, S k, S v) { c.body.void_density = number(k, v); }},
      {"axle", [](C c, S k, S v) { c.body.axle.radius = number(k, v); }},
      {"slot", [](C c, S k, S v) { c.body.axle.slot = number(k, v); }},
      {"axle-depth", [](C c, S k, S v) { c.body.axle.depth = number(k, v); }},
      {"fineness", [](C c, S k, S v) { c.body.fineness = whole(k, v, 1); }},
  };
}

/// What is asked, over which domain.
Setters question_setters() {
  return {
      // A name that nobody knows is told where it is written, not when its turn comes.
      {"problem", [](C c, S, S v) { c.problem = find_problem(v).name; }},
      {"formulation", [](C c, S, S v) { c.formulation = find_formulation(v).name; }},
      {"solver",
       [](C c, S, S v) {
         (void)solvers().find(v);
         c.solver = v;
       }},
      {"domain",
       [](C c, S k, S v) {
         if (v != "columns" && v != "exact") refuse(k, v, "columns or exact");
         c.domain = v;
       }},
      {"resolution", [](C c, S k, S v) { c.grid = grid(k, v); }},
      {"level", [](C c, S k, S v) { c.grid = grid_of_level(k, v); }},
      {"wall",
       [](C c, S, S v) {
         const bool to_corners = c.wall.to_corners;
         c.wall = parse_wall(std::string(v));
         c.wall.to_corners = to_corners;
       }},
      {"wall-to",
       [](C c, S k, S v) {
         if (v != "centres" && v != "corners") refuse(k, v, "centres or corners");
         c.wall.to_corners = v == "corners";
       }},
  };
}

/// A map in place of a run, what becomes of the optimum, and where it is computed.
Setters kind_setters() {
  return {
      {"axes", [](C c, S k, S v) { map_of(c).axes = whole(k, v, 1); }},
      {"through",
       [](C c, S k, S v) {
         if (v != "lowest" && v != "centre") refuse(k, v, "lowest or centre");
         map_of(c).through = v == "centre" ? Through::centre : Through::lowest;
       }},
      {"drafts",
       [](C c, S, S v) {
         const auto parts = split(v, ',');
         map_of(c).drafts = {parts.begin(), parts.end()};
       }},
      {"rounding",
       [](C c, S k, S v) {
         if (v != "nearest" && v != "fitted") refuse(k, v, "nearest or fitted");
         c.rounding = v == "nearest" ? Rounding::nearest : Rounding::fitted;
       }},
      {"part",
       [](C c, S k, S v) {
         if (v != "none" && v != "written") refuse(k, v, "none or written");
         c.part = v == "none" ? Part::none : Part::written;
       }},
      {"device", [](C c, S, S v) { c.device = v; }},
      {"precision",
       [](C c, S k, S v) {
         if (v != "automatic" && v != "single") refuse(k, v, "automatic or single");
         c.single_precision = v == "single";
       }},
  };
}

/// How often, how long, how near.
Setters limit_setters() {
  return {
      {"repeat", [](C c, S k, S v) { c.repeat = whole(k, v, 1); }},
      {"budget",
       [](C c, S k, S v) {
         c.budget_seconds = number(k, v);
         if (c.budget_seconds < 0) refuse(k, v, "seconds >= 0");
       }},
      {"memory",
       [](C c, S k, S v) {
         c.limits.gigabytes = number(k, v);
         if (!(c.limits.gigabytes > 0)) refuse(k, v, "GB > 0");
       }},
      {"seconds",
       [](C c, S k, S v) {
         c.limits.seconds = number(k, v);
         if (!(c.limits.seconds > 0)) refuse(k, v, "seconds > 0");
       }},
      {"certify",
       [](C c, S k, S v) {
         c.certify = number(k, v);
         if (!(c.certify > 0 && c.certify < 1)) refuse(k, v, "a gap between 0 and 1, such as 1e-3");
       }},
  };
}

const Setters& setters() {
  static const Setters all = [] {
    Setters joined;
    for (Setters group :
         {body_setters(), shape_setters(), question_setters(), kind_setters(), limit_setters()})
      joined.merge(group);
    return joined;
  }();
  return all;
}

}  // namespace

void set_field(RunConfig& config, std::string_view key, std::string_view value) {
  if (is_setting(key)) {
    config.settings[std::string(key)] = value;
    return;
  }
  if (!is_field(key)) {
    const std::string_view group = key.substr(0, key.find('.'));
    if (group != key && std::ranges::find(groups, group) == groups.end())
      throw unknown_name(fmt::format("setting '{}': group", key), group, groups);
    throw unknown_name("field", key, field_names());
  }
  setters().at(key)(config, key, value);
}

bool is_field(std::string_view key) { return is_setting(key) || setters().contains(key); }

std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, setter] : setters()) names.push_back(name);
  for (const std::string_view name :
       {"ipopt.NAME", "moment.NAME", "slsqp.NAME", "problem.NAME", "formulation.NAME", "solver.NAME"})
    names.push_back(name);
  return names;
}

std::string solver_of(const RunConfig& config) {
  return std::string(config.solver.empty() ? default_solver(config.formulation).name : config.solver);
}

std::string domain_of(const RunConfig& config) {
  const bool exact = config.formulation == "quadric";
  if (config.domain.empty()) return exact ? "exact" : "columns";
  if (config.domain == "exact" && !exact)
    throw InputError(fmt::format("domain 'exact' does not work with formulation '{}'; it works with: quadric",
                                 config.formulation));
  return config.domain;
}

std::map<std::string, std::string> settings_of(const RunConfig& config, std::string_view group) {
  std::map<std::string, std::string> result;
  for (const auto& [key, value] : config.settings)
    if (key.starts_with(group) && key.size() > group.size() && key[group.size()] == '.')
      result[key.substr(group.size() + 1)] = value;
  return result;
}

namespace {

/// The pose that is to be found, and what is made along its axis.
void describe_free(const RunConfig& config, std::map<std::string, std::string>& fields) {
  const StemSpec& stem = config.body.stem;
  if (stem.radius) fields["stem"] = fmt::format("{}", *stem.radius);
  if (stem.tip_radius)
    fields["tip"] = stem.tip_height ? fmt::format("{},{}", *stem.tip_radius, *stem.tip_height)
                                    : fmt::format("{}", *stem.tip_radius);
  if (config.flatten) fields["flatten"] = "auto";
  if (config.body.flatten) fields["flatten"] = fmt::format("{}", *config.body.flatten);
  if (!config.free) return;
  const FreePose& free = *config.free;
  if (!config.body.axis)
    fields[find_problem(config.problem).upright ? "up" : "axis"] =
        free.rest   ? fmt::format("rest:{}", *free.rest)
        : free.near ? "near:" + field_text::text_of(*free.near)
                    : std::string("auto");
  if (free.through) fields["axis-through"] = *free.through == Through::centre ? "centre" : "lowest";
}

}  // namespace

std::map<std::string, std::string> describe(const RunConfig& config) {
  std::map<std::string, std::string> fields = config.settings;
  fields["model"] = config.body.model;
  fields["problem"] = config.problem;
  fields["formulation"] = config.formulation;
  fields["solver"] = solver_of(config);
  if (domain_of(config) != "columns") fields["domain"] = domain_of(config);
  fields["resolution"] = text_of(config.grid);
  fields["wall"] = to_string(config.wall);
  if (config.wall.to_corners) fields["wall-to"] = "corners";
  fields["density"] = fmt::format("{}", config.body.density);
  if (config.body.interior_density)
    fields["interior-density"] = fmt::format("{}", *config.body.interior_density);
  if (config.body.void_density != 0) fields["void-density"] = fmt::format("{}", config.body.void_density);
  if (config.body.axis) fields["axis"] = text_of(*config.body.axis);
  if (config.body.up) fields["up"] = text_of(*config.body.up);
  if (config.body.contact) fields["contact"] = text_of(*config.body.contact);
  if (config.body.unit) fields["unit"] = config.body.unit->name;
  if (config.body.weld) fields["weld"] = fmt::format("{}", *config.body.weld);
  if (config.body.size) fields["size"] = fmt::format("{}", *config.body.size);
  describe_free(config, fields);
  if (config.body.axle.radius) fields["axle"] = fmt::format("{}", *config.body.axle.radius);
  if (config.body.axle.slot) fields["slot"] = fmt::format("{}", *config.body.axle.slot);
  if (config.body.axle.depth) fields["axle-depth"] = fmt::format("{}", *config.body.axle.depth);
  if (config.body.fineness) fields["fineness"] = std::to_string(config.body.fineness);
  if (config.rounding == Rounding::nearest) fields["rounding"] = "nearest";
  if (config.part == Part::none) fields["part"] = "none";
  if (config.map) {
    fields["axes"] = std::to_string(config.map->axes);
    fields["through"] = config.map->through == Through::centre ? "centre" : "lowest";
    if (!config.map->drafts.empty()) fields["drafts"] = fmt::format("{}", fmt::join(config.map->drafts, ","));
  }
  if (!config.device.empty()) fields["device"] = config.device;
  if (config.single_precision) fields["precision"] = "single";
  if (config.certify > 0) fields["certify"] = fmt::format("{}", config.certify);
  return fields;
}

std::string run_name(const RunConfig& config) {
  const auto fields = describe(config);
  const std::string way = config.map ? "map" : config.formulation + "-" + solver_of(config);
  return fmt::format("{}-{}-{}-{}-{:08x}", std::filesystem::path(config.body.model).stem().string(),
                     fields.at("resolution"), config.problem, way, hash(fields));
}

}  // namespace kreisel::core
