// run.hpp - a run of any kind: what defines it, its fields by name, and what it is called.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "run/nest_config.hpp"
#include "run/simulation.hpp"
#include "session/config.hpp"
#include "session/map_run.hpp"
#include "settings/field.hpp"

namespace kreisel::core {

using Run = std::variant<RunConfig, MapRun, SimulationRun, NestConfig>;

/// A kind of run: its name, and every field that it has. Command lines, TOML, records and the docs go by
/// this.
struct RunKind {
  std::string_view name;                 ///< solve, map, simulation, scale, test, swarm, layers, ...
  std::string_view what;                 ///< "a nesting of layers"
  std::string_view help;                 ///< one line
  std::vector<std::string_view> by;      ///< fields that only a run of this kind begins with
  std::vector<std::string_view> groups;  ///< of settings GROUP.NAME beside the fields; none: it takes none
  Run empty;                             ///< a run of the kind, at its defaults
  Fields<Run> fields;
};

[[nodiscard]] const std::vector<RunKind>& run_kinds();
/// @throws InputError  unknown: says the nearest
[[nodiscard]] const RunKind& find_run_kind(std::string_view name);
[[nodiscard]] const RunKind& run_kind_of(const Run& run);

/// The kind of a run of which these fields are given.
/// @param nesting  it is one of the nestings, whether an outer shape is given or not
[[nodiscard]] const RunKind& kind_of_fields(const std::vector<std::string_view>& names, bool nesting = false);

/// Whether any kind has the field, or its group takes such settings.
[[nodiscard]] bool is_field(std::string_view name);
/// Every field of any kind, each once; settings without an option of their own are not among them.
[[nodiscard]] std::vector<std::string_view> field_names();

/// @throws InputError  a field of other kinds (names those), or of none; a value that does not fit
void set_field(Run& run, std::string_view name, std::string_view value);

/// A field or setting with its text, and where that was written: what a message about it begins with.
struct GivenText {
  std::string name, text;
  std::string where = {};
};

/// @throws InputError  as set_field(), with `where` before it
[[nodiscard]] Run make_run(const std::vector<GivenText>& given, const RunKind& kind);
/// Of the kind that the fields say.
[[nodiscard]] Run make_run(const std::vector<GivenText>& given);

/// What set_field() cannot see in one field. @throws InputError
void require_valid(const Run& run);

/// The text of a field; empty: its kind has none of that name.
[[nodiscard]] std::string text_of(const Run& run, std::string_view name);

/// Models and mesh files that a run reads, each once.
[[nodiscard]] std::vector<std::string> shapes_of(const Run& run);

/// What is asked of a body; nullptr: it is a nesting.
[[nodiscard]] const Asked* asked_of(const Run& run);
[[nodiscard]] Asked* asked_of(Run& run);

/// Every field that defines the result, as text; the identity of a run.
[[nodiscard]] std::map<std::string, std::string> describe(const Run& run);
/// The stem of its record: readable parts and a hash of describe().
[[nodiscard]] std::string run_name(const Run& run);
/// How lists and progress name it: "ellipsoid 80x52x51 voxel ipopt", "bunny 100 spin map through centre",
/// "bunny in bunny hybrid+abort all seed 3".
[[nodiscard]] std::string run_text(const Run& run);

}  // namespace kreisel::core
