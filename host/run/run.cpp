#include "run/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "words.hpp"

namespace kreisel::core {
namespace {

template <class Kind>
Fields<Run> fields_of_run(const Fields<Kind>& fields) {
  return fields_of_part<Run>(
      fields, [](auto& run) -> auto& { return std::get<Kind>(run); });
}

std::vector<RunKind> make_run_kinds() {
  const std::vector<std::string_view>& groups = setting_groups();
  std::vector<RunKind> all = {
      {"solve",
       "a solve",
       "the best interior of a body, and the part made of it",
       {},
       groups,
       RunConfig(),
       fields_of_run(solve_fields())},
      {"map",
       "a map of orientations",
       "about which axes a body can spin, or float: every orientation over one domain",
       {"axes", "through", "drafts"},
       {"moment", "problem", "formulation", "solver"},
       MapRun(),
       fields_of_run(map_fields())},
      {"simulation",
       "a simulation",
       "a part, and the solid it was made of, set in motion",
       {"touch", "omega", "tilt", "scan"},
       groups,
       SimulationRun(),
       fields_of_run(simulation_fields())}};
  for (const NestKindEntry& nesting : nest_kinds()) {
    NestConfig empty;
    empty.kind = nesting.empty;
    all.push_back(
        {nesting.name, nesting.what, nesting.help, {"outer"}, {}, empty, fields_of_run(nesting.fields)});
  }
  return all;
}

bool has(const std::vector<std::string_view>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string_view group_of(std::string_view name) { return name.substr(0, name.find('.')); }

/// Whether a run of this kind can be told this.
bool takes(const RunKind& kind, std::string_view name) {
  return find_field(kind.fields, name) || (is_setting(name) && has(kind.groups, group_of(name)));
}

std::string nest_text(const NestConfig& nest) {
  const auto* swarm = std::get_if<NestSwarm>(&nest.kind);
  if (!swarm) return fmt::format("{} {}", shapes_text(nest), kind_of(nest));
  return fmt::format("{} {} {} seed {}", shapes_text(nest), swarm->swarm, swarm->free, seed_of(nest));
}

std::string text(const NestConfig& nest) { return nest_text(nest); }
std::string text(const MapRun& map) {
  return fmt::format("{} {} {} map{}", model_text(map), grid_text(map.grid), map.problem,
                     map.through == Through::centre ? " through centre" : "");
}
std::string text(const SimulationRun& run) {
  return fmt::format("{} {} {} simulation", model_text(run), grid_text(run.grid), run.problem);
}
std::string text(const RunConfig& run) {
  return fmt::format("{} {} {} {}", model_text(run), grid_text(run.grid), run.formulation, solver_of(run));
}

/// By now it is known whom they are for.
void require_settings(const Asked& asked, const std::vector<GivenText>& given) {
  for (const GivenText& field : given)
    if (is_setting(field.name)) try {
        require_setting(asked, field.name, field.text);
      } catch (const InputError& error) {
        throw InputError(field.where + error.what());
      }
}

}  // namespace

const std::vector<RunKind>& run_kinds() {
  static const std::vector<RunKind> all = make_run_kinds();
  return all;
}

const RunKind& find_run_kind(std::string_view name) {
  const auto found = std::ranges::find(run_kinds(), name, &RunKind::name);
  if (found == run_kinds().end()) throw unknown_name("kind of run", name, names_of(run_kinds()));
  return *found;
}

const RunKind& run_kind_of(const Run& run) {
  if (const auto* nest = std::get_if<NestConfig>(&run)) return find_run_kind(kind_of(*nest));
  return run_kinds()[run.index()];
}

const RunKind& kind_of_fields(const std::vector<std::string_view>& names, bool nesting) {
  if (nesting || has(names, "outer")) return find_run_kind(nest_kind_of(names).name);
  for (const RunKind& kind : run_kinds())
    if (std::ranges::any_of(kind.by, [&](std::string_view name) { return has(names, name); })) return kind;
  return run_kinds().front();
}

bool is_field(std::string_view name) {
  return std::ranges::any_of(run_kinds(), [&](const RunKind& kind) { return takes(kind, name); });
}

std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for (const RunKind& kind : run_kinds())
    for (const Field<Run>& field : kind.fields)
      if (!is_setting(field.name) && !has(names, field.name)) names.push_back(field.name);
  return names;
}

void set_field(Run& run, std::string_view name, std::string_view value) {
  const RunKind& own = run_kind_of(run);
  if (const Field<Run>* field = find_field(own.fields, name)) return field->set(run, name, value);
  Asked* asked = asked_of(run);
  if (asked && takes(own, name)) return set_setting(*asked, name, value);
  std::vector<std::string_view> kinds, others;  // nestings among nestings, if any
  for (const RunKind& kind : run_kinds())
    if (takes(kind, name))
      (kind.empty.index() == run.index() || (asked && asked_of(kind.empty)) ? kinds : others)
          .push_back(kind.name);
  if (kinds.empty()) kinds = others;
  if (!kinds.empty()) throw not_a_field_of(own.what, name, kinds);
  if (group_of(name) != name)
    throw unknown_name(fmt::format("setting '{}': group", name), group_of(name), setting_groups());
  throw unknown_name("field", name, field_names());
}

Run make_run(const std::vector<GivenText>& given, const RunKind& kind) {
  Run run = kind.empty;
  for (const GivenText& field : given) try {
      set_field(run, field.name, field.text);
    } catch (const InputError& error) {
      if (field.where.empty()) throw;
      throw InputError(field.where + error.what());
    }
  if (const Asked* asked = asked_of(run)) require_settings(*asked, given);
  return run;
}

Run make_run(const std::vector<GivenText>& given) {
  std::vector<std::string_view> names;
  for (const GivenText& field : given) names.push_back(field.name);
  return make_run(given, kind_of_fields(names));
}

void require_valid(const Run& run) {
  if (const auto* nest = std::get_if<NestConfig>(&run)) require_valid(*nest);
}

std::string text_of(const Run& run, std::string_view name) {
  const Field<Run>* field = find_field(run_kind_of(run).fields, name);
  return field ? field->text(run) : "";
}

std::vector<std::string> shapes_of(const Run& run) {
  std::vector<std::string> shapes;
  for (const Field<Run>& field : run_kind_of(run).fields) {
    if (!field.shapes) continue;
    const std::string said = field.text(run);
    for (std::string& shape : field.words == 1 ? std::vector{said} : split_words(said))
      if (!shape.empty() && std::ranges::find(shapes, shape) == shapes.end())
        shapes.push_back(std::move(shape));
  }
  return shapes;
}

const Asked* asked_of(const Run& run) {
  return std::visit(
      [](const auto& kind) -> const Asked* {
        if constexpr (std::is_base_of_v<Asked, std::decay_t<decltype(kind)>>) return &kind;
        return nullptr;
      },
      run);
}
Asked* asked_of(Run& run) { return const_cast<Asked*>(asked_of(std::as_const(run))); }

std::map<std::string, std::string> describe(const Run& run) {
  return std::visit([](const auto& kind) { return describe(kind); }, run);
}
std::string run_name(const Run& run) {
  return std::visit([](const auto& kind) { return run_name(kind); }, run);
}
std::string run_text(const Run& run) {
  return std::visit([](const auto& kind) { return text(kind); }, run);
}

}  // namespace kreisel::core
