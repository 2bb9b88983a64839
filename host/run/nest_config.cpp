#include "run/nest_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "error.hpp"
#include "nest/search/baseline.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {
namespace {

std::string stem(const std::string& model) { return std::filesystem::path(model).stem().string(); }

/// The field that makes it what it is was given.
void require_count(std::string_view name, int count) {
  if (count < 1) throw InputError(fmt::format("{} = '{}'; expected a whole number >= 1", name, count));
}

void require_valid_search(const NestSearch& search, std::string_view kind) {
  if (search.free.empty())
    throw InputError(fmt::format("{} without free; expected what the search may change, such as all", kind));
  const nest::SwarmOptions& swarm = search.search.swarm;
  if (const auto what = swarm.invalid()) throw InputError("swarm: " + *what);
  if (const auto what = search.search.climb.invalid()) throw InputError("climb: " + *what);
  if (!nest::is_baseline(search.swarm)) return;
  const int least = nest::find_baseline(search.swarm).least_particles;
  if (swarm.particles < least)
    throw InputError(
        fmt::format("{} with {} particles; expected at least {}", search.swarm, swarm.particles, least));
}

}  // namespace

const NestKindEntry& entry_of(const NestConfig& config) { return nest_kinds()[config.kind.index()]; }

const NestKindEntry& nest_kind_of(const std::vector<std::string_view>& names) {
  const std::vector<NestKindEntry>& all = nest_kinds();
  // Layers are searched for, too: what is more than a search comes after it in the list.
  for (auto kind = all.rbegin(); kind != all.rend(); ++kind)
    if (std::ranges::find(names, kind->by) != names.end()) return *kind;
  return all.front();
}

NestConfig make_nest(const GivenFields& given) {
  std::vector<std::string_view> names;
  for (const auto& [name, text] : given) names.push_back(name);
  NestConfig config;
  config.kind = nest_kind_of(names).empty;
  for (const auto& [name, text] : given) set_field(config, name, text);
  return config;
}

void set_field(NestConfig& config, std::string_view name, std::string_view value) {
  const NestKindEntry& own = entry_of(config);
  if (const Field<NestConfig>* field = find_field(own.fields, name)) return field->set(config, name, value);
  std::vector<std::string_view> kinds, names;
  for (const NestKindEntry& kind : nest_kinds()) {
    if (find_field(kind.fields, name)) kinds.push_back(kind.name);
    for (const Field<NestConfig>& field : kind.fields)
      if (std::ranges::find(names, field.name) == names.end()) names.push_back(field.name);
  }
  if (kinds.empty()) throw unknown_name("field", name, names);
  throw not_a_field_of(own.what, name, kinds);
}

void require_valid(const NestConfig& config) {
  if (config.outer.empty())
    throw InputError("no outer shape; expected a name of `bench list` or a mesh file");
  if (const auto* search = part_of<NestSearch>(config)) require_valid_search(*search, kind_of(config));
  if (const auto* layers = part_of<NestLayers>(config)) require_count("layers", layers->layers);
  if (const auto* accuracy = part_of<NestAccuracy>(config)) require_count("accuracy", accuracy->accuracy);
  if (const auto* outlines = part_of<NestOutlines>(config)) require_count("landscape", outlines->landscape);
  if (const auto* test = part_of<NestTest>(config); test && !test->scale)
    throw InputError("a test of one scale without scale; expected one");
}

std::map<std::string, std::string> describe(const NestConfig& config) {
  const NestKindEntry& own = entry_of(config);
  NestConfig defaults;
  defaults.kind = own.empty;
  return describe(own.fields, config, defaults);
}

std::string_view kind_of(const NestConfig& config) { return entry_of(config).name; }

std::uint64_t seed_of(const NestConfig& config) {
  if (const auto* accuracy = part_of<NestAccuracy>(config)) return accuracy->seed;
  const auto* search = part_of<NestSearch>(config);
  return search ? search->search.swarm.seed : 1;
}

std::string shapes_text(const NestConfig& config) {
  std::string text;
  if (const auto* layers = part_of<NestLayers>(config))
    for (auto shape = layers->within.rbegin(); shape != layers->within.rend(); ++shape)
      text += stem(*shape) + " in ";
  return text + fmt::format("{} in {}", stem(config.inner.empty() ? config.outer : config.inner),
                            stem(config.outer));
}

std::string run_name(const NestConfig& config) {
  std::string shapes = shapes_text(config);
  std::ranges::replace(shapes, ' ', '-');
  return fmt::format("{}-{}-{:08x}", shapes, kind_of(config), field_text::hash(describe(config)));
}

}  // namespace kreisel::core
