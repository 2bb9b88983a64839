#include "run/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include "error.hpp"

namespace kreisel {
namespace {

constexpr std::array<std::string_view, 4> groups = {"ipopt", "problem", "formulation", "solver"};

[[noreturn]] void refuse(std::string_view key, std::string_view value, std::string_view expected) {
  throw InputError(fmt::format("{} = '{}'; expected {}", key, value, expected));
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size();
}

double number(std::string_view key, std::string_view value) {
  double result = 0;
  if (!parse(value, result) || !std::isfinite(result)) refuse(key, value, "a number");
  return result;
}

int whole(std::string_view key, std::string_view value, int least) {
  int result = 0;
  if (!parse(value, result) || result < least) refuse(key, value, fmt::format("a whole number >= {}", least));
  return result;
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t cut; (cut = text.find(at)) != std::string_view::npos; text.remove_prefix(cut + 1))
    parts.push_back(text.substr(0, cut));
  parts.push_back(text);
  return parts;
}

Vec3 vector(std::string_view key, std::string_view value) {
  const auto parts = split(value, ',');
  Vec3 v;
  if (parts.size() != 3) refuse(key, value, "three numbers x,y,z");
  for (int a = 0; a < 3; ++a)
    if (!parse(parts[a], v[a]) || !std::isfinite(v[a])) refuse(key, value, "three numbers x,y,z");
  return v;
}

GridSpec grid(std::string_view key, std::string_view value) {
  GridSpec spec;
  const auto parts = split(value, 'x');
  std::array<int, 3> cells{};
  if (parts.size() == 1 && parse(parts[0], spec.resolution) && spec.resolution >= 2) return spec;
  if (parts.size() == 3 && parse(parts[0], cells[0]) && parse(parts[1], cells[1]) &&
      parse(parts[2], cells[2])) {
    spec.cells = cells;
    return spec;
  }
  refuse(key, value, "cells along the longest side (2 to 1024), or NXxNYxNZ");
}

std::string text_of(const Vec3& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

std::string text_of(const GridSpec& spec) {
  return spec.cells ? fmt::format("{}", fmt::join(*spec.cells, "x")) : std::to_string(spec.resolution);
}

bool is_setting(std::string_view key) {
  for (const std::string_view group : groups)
    if (key.size() > group.size() + 1 && key.starts_with(group) && key[group.size()] == '.') return true;
  return false;
}

using Setter = std::function<void(RunConfig&, std::string_view key, std::string_view value)>;

const std::map<std::string_view, Setter>& setters() {
  using C = RunConfig&;
  using S = std::string_view;
  static const std::map<std::string_view, Setter> all = {
      {"model", [](C c, S, S v) { c.body.model = v; }},
      {"axis", [](C c, S k, S v) { c.body.axis = vector(k, v); }},
      {"up", [](C c, S k, S v) { c.body.up = vector(k, v); }},
      {"contact", [](C c, S k, S v) { c.body.contact = vector(k, v); }},
      {"size", [](C c, S k, S v) { c.body.size = number(k, v); }},
      {"density", [](C c, S k, S v) { c.body.density = number(k, v); }},
      {"fineness", [](C c, S k, S v) { c.body.fineness = whole(k, v, 1); }},
      {"problem", [](C c, S, S v) { c.problem = v; }},
      {"formulation", [](C c, S, S v) { c.formulation = v; }},
      {"solver", [](C c, S, S v) { c.solver = v; }},
      {"resolution", [](C c, S k, S v) { c.grid = grid(k, v); }},
      {"wall", [](C c, S, S v) { c.wall = parse_wall(std::string(v)); }},
      {"device", [](C c, S, S v) { c.device = v; }},
      {"precision",
       [](C c, S k, S v) {
         if (v != "automatic" && v != "single") refuse(k, v, "automatic or single");
         c.single_precision = v == "single";
       }},
      {"repeat", [](C c, S k, S v) { c.repeat = whole(k, v, 1); }},
      {"budget",
       [](C c, S k, S v) {
         c.budget_seconds = number(k, v);
         if (c.budget_seconds < 0) refuse(k, v, "seconds >= 0");
       }},
  };
  return all;
}

std::uint64_t hash(const std::map<std::string, std::string>& fields) {
  std::uint64_t h = 0xcbf29ce484222325ull;  // FNV-1a
  for (const auto& [key, value] : fields)
    for (const char c : key + "=" + value + "\n") h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return h;
}

}  // namespace

void set_field(RunConfig& config, std::string_view key, std::string_view value) {
  if (is_setting(key)) {
    config.settings[std::string(key)] = value;
    return;
  }
  const auto found = setters().find(key);
  if (found == setters().end()) {
    std::vector<std::string_view> names;
    for (const auto& [name, setter] : setters()) names.push_back(name);
    throw InputError(fmt::format("'{}' is not a field of a run; expected one of {}, or {}.NAME", key,
                                 fmt::join(names, " "), fmt::join(groups, ".NAME ")));
  }
  found->second(config, key, value);
}

std::map<std::string, std::string> settings_of(const RunConfig& config, std::string_view group) {
  std::map<std::string, std::string> result;
  for (const auto& [key, value] : config.settings)
    if (key.starts_with(group) && key.size() > group.size() && key[group.size()] == '.')
      result[key.substr(group.size() + 1)] = value;
  return result;
}

std::map<std::string, std::string> describe(const RunConfig& config) {
  std::map<std::string, std::string> fields = config.settings;
  fields["model"] = config.body.model;
  fields["problem"] = config.problem;
  fields["formulation"] = config.formulation;
  fields["solver"] = config.solver;
  fields["resolution"] = text_of(config.grid);
  fields["wall"] = to_string(config.wall);
  fields["density"] = fmt::format("{}", config.body.density);
  if (config.body.axis) fields["axis"] = text_of(*config.body.axis);
  if (config.body.up) fields["up"] = text_of(*config.body.up);
  if (config.body.contact) fields["contact"] = text_of(*config.body.contact);
  if (config.body.size) fields["size"] = fmt::format("{}", *config.body.size);
  if (config.body.fineness) fields["fineness"] = std::to_string(config.body.fineness);
  if (!config.device.empty()) fields["device"] = config.device;
  if (config.single_precision) fields["precision"] = "single";
  return fields;
}

std::string run_name(const RunConfig& config) {
  const auto fields = describe(config);
  return fmt::format("{}-{}-{}-{}-{}-{:08x}", std::filesystem::path(config.body.model).stem().string(),
                     fields.at("resolution"), config.problem, config.formulation, config.solver,
                     static_cast<std::uint32_t>(hash(fields) ^ hash(fields) >> 32));
}

}  // namespace kreisel
