#include "print/gcode/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "error.hpp"
#include "print/gcode/levels.hpp"
#include "print/gcode/remark.hpp"

namespace kreisel::core {
namespace {

constexpr std::size_t most_layers = 100000, most_names = 10000, longest_name = 200;

}  // namespace

int Tally::Names::of(std::string_view name, const char* what) {
  name = name.substr(0, longest_name);
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) return found->second;
  if (names_.size() > most_names)
    throw InputError(fmt::format("more than {} {}, expected no more", most_names, what));
  const int number = static_cast<int>(names_.size());
  names_.emplace_back(name);
  numbers_.emplace(name, number);
  return number;
}

void Tally::set_type(std::string_view type) {
  const int number = types_.of(type, "types");
  if (number != key_.type) flush();
  if (!typed_) {
    typed_ = true;
    layers_.clear();
    feet_.clear();
    part_ = {};
    begins_layer_ = true;
  }
  key_.type = number;
}

void Tally::set_object(std::string_view label) {
  const int number = objects_.of(label, "objects");
  if (number != key_.object) flush();
  key_.object = number;
}

void Tally::set_source(const FilamentSource& source) {
  if (source != key_.source) flush();
  key_.source = source;
}

void Tally::set_beside(bool is) {
  if (is != key_.beside) flush();
  key_.beside = is;
}

void Tally::begin_layer() {
  flush();
  begins_layer_ = true;
}

bool Tally::of_part(const Key& key) const {
  return !key.beside && (key.type == 0 ? !typed_ : is_of_part(types_.name(key.type)));
}

void Tally::flush() {
  if (!(run_.filament() > 0)) return;
  groups_.try_emplace(key_, Group{groups_.size(), {}}).first->second.sum += run_;
  if (of_part(key_)) {
    if (begins_layer_) {
      if (layers_.size() == most_layers)
        throw InputError(fmt::format("more than {} layers, expected no more", most_layers));
      layers_.push_back({layer_z_});
      begins_layer_ = false;
    }
    layers_.back().sums[key_.source] += run_;
    stand_on(layers_.back().z);
    part_.add(reach_.lo);
    part_.add(reach_.hi);
  }
  run_ = {};
  reach_ = {};
}

void Tally::stand_on(double z) {
  Foot& foot = feet_.try_emplace(key_.object, Foot{feet_.size(), z}).first->second;
  if (z > foot.z + Levels::same) return;
  if (z < foot.z - Levels::same) foot = {foot.began, z};
  foot.sum += run_;
}

void Tally::add_to(Print& print, bool all_volumetric) {
  flush();
  const auto filament = [&](const FilamentSource& source) -> const Filament& {
    return print.filaments[std::size_t(source.tool)];
  };
  const auto moments = [&](const FilamentSource& source, const Beads& sum) {
    const double d = filament(source).diameter;
    return sum.moments(source.volumetric || all_volumetric ? 1 : std::numbers::pi / 4 * d * d);
  };
  print.groups.resize(groups_.size());
  for (const auto& [key, group] : groups_)
    print.groups[group.began] = {
        types_.name(key.type), objects_.name(key.object),    key.source.tool,
        of_part(key),          filament(key.source).density, moments(key.source, group.sum)};
  print.part = part_;
  print.objects.resize(feet_.size());
  for (const auto& [object, foot] : feet_)
    print.objects[foot.began] = {objects_.name(object), centre_of_mass(foot.sum.moments(1))};
  for (const Layer& layer : layers_) {
    PrintLayer& one = print.layers.emplace_back();
    one.z = layer.z;
    for (const auto& [source, sum] : layer.sums) {
      const Moments m = moments(source, sum);
      one.volume += m[S1];
      one.mass += 1e-3 * filament(source).density * m;
    }
  }
}

}  // namespace kreisel::core
