// question.hpp - what may be asked of a body.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kreisel/export.hpp"
#include "kreisel/mesh.hpp"

namespace kreisel {

/// How the body lies; model coordinates, mm. What is left out comes from the body: +z, its lowest point.
struct Pose {
  std::optional<Vec3> axis;     ///< to spin about; any length but zero
  std::optional<Vec3> up;       ///< to stand or float by
  std::optional<Vec3> contact;  ///< a point of the axis; after `size`
  std::optional<double> size;   ///< longest side of the bounding box, mm; none: as the mesh is
  /// In place of axis, up and contact, what is to be found: "auto", the pose that does best what is asked;
  /// "near:x,y,z", the best within 30 degrees of it; "rest:N", the N-th most probable way of lying. Empty:
  /// nothing.
  std::string find = {};
  std::optional<double> stem, tip, tip_height;  ///< a peg to spin on, its cone's radius and height, mm
  std::optional<double> flatten;                ///< what is cut off at the bottom, mm
  /// Of a yo-yo, mm: radius of the axle, gap between the halves, depth of its holes.
  std::optional<double> axle, slot, axle_depth;

  bool operator==(const Pose&) const = default;
};

/// g/cm^3.
struct Densities {
  double shell = 1;
  std::optional<double> interior = {};  ///< of what is left of the interior; none: the shell's
  double filling = 0;                   ///< of what fills the voids

  bool operator==(const Densities&) const = default;
};

/// What of the body can be filled.
struct DomainSpec {
  std::string kind = {};                  ///< exact or columns; empty: the formulation's own
  std::array<int, 3> cells = {64, 0, 0};  ///< along the longest side; or the whole grid, three numbers
  double wall_mm = 1.2;                   ///< least thickness that stays
  std::string wall = {};                  ///< in its place: "2%" of the longest side, "1.5h" cells

  bool operator==(const DomainSpec&) const = default;
};

/// One of the entries that `bench list` names, with settings as its documentation names them.
struct Choice {
  std::string name;
  std::map<std::string, std::string> settings = {};

  bool operator==(const Choice&) const = default;
};

/// A session makes again only what differs from the question before.
struct Question {
  Pose pose = {};
  Densities densities = {};
  DomainSpec domain = {};
  Choice problem = {"spin"}, formulation = {"quadric"};
  Choice solver = {""};  ///< empty: the first that works with the formulation
  double certify = 0;    ///< relative gap to prove between result and bound; 0: no certificate
  /// What no member above says, applied after them: text by name of a field, as set_field() takes it.
  std::map<std::string, std::string> fields = {};

  bool operator==(const Question&) const = default;
};

/// A field of `bench fields solve` that a question has, or a word of the library's own.
struct QuestionField {
  std::string name;     ///< as TOML and records call it: axle-depth, problem.draft
  std::string keyword;  ///< as a language calls it: axle_depth, draft
  std::string unit;     ///< of its value, or what that looks like; empty: text, or a number without unit
  std::string help;
};

[[nodiscard]] KREISEL_API const std::vector<QuestionField>& question_fields();

/// Sets a field by its name or keyword, or a setting GROUP.NAME: the member that can say it, else `fields`.
/// @param text  as `bench` takes it: "1.5h", "0,0,1", "auto"; empty: as if it had never been said
/// @throws InputError  no such field, says the nearest; a value that does not fit, with what was expected
KREISEL_API void set_field(Question& question, const std::string& name, const std::string& text);

/// The text of a field as the question asks it; empty: it says nothing.
/// @throws InputError  no such field; a question that does not fit
[[nodiscard]] KREISEL_API std::string text_of(const Question& question, const std::string& name);

}  // namespace kreisel
