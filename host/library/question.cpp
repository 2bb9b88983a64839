#include "kreisel/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "library/config_of.hpp"
#include "parse.hpp"
#include "problem/problem.hpp"
#include "settings/field_text.hpp"

namespace kreisel {
namespace core {
namespace {

using S = std::string_view;

// Members as the text of their field, where empty says nothing, and set from it. False: a member has no such
// value.

std::string said(double v) { return fmt::format("{}", v); }
std::string said(const std::optional<double>& v) { return v ? said(*v) : ""; }
std::string said(const std::optional<Vec3>& v) { return v ? field_text::text_of(*v) : ""; }
std::string said(const std::string& text) { return text; }
std::string said(const std::array<int, 3>& cells) {
  const auto [x, y, z] = cells;
  return y == 0 && z == 0 ? fmt::format("{}", x) : fmt::format("{}x{}x{}", x, y, z);
}

bool take(std::optional<double>& member, S text) { return (member = parse<double>(text)).has_value(); }
bool take(std::optional<Vec3>& member, S text) { return (member = parse_vector(text)).has_value(); }
bool take(std::string& member, S text) {
  member = text;
  return true;
}
bool take(double& member, S text) {
  const auto value = parse<double>(text);
  if (value) member = *value;
  return value.has_value();
}
bool take(std::array<int, 3>& cells, S text) {
  const auto parts = field_text::split(text, 'x');
  cells = {0, 0, 0};
  for (std::size_t i = 0; i < std::min(parts.size(), cells.size()); ++i)
    cells[i] = parse<int>(parts[i]).value_or(0);
  return true;
}

/// A field that a question has a member for. What is no field of a solve says what it is, and what it does.
struct Member {
  S name;
  std::function<std::string(const Question&)> text;
  std::function<bool(Question&, S)> take;
  std::function<void(Question&)> forget;
  S unit = {}, help = {};
  void (*apply)(RunConfig& config, S text) = nullptr;
};

template <class Of>
Member member(S name, Of of) {
  return {name, [of](const Question& q) { return said(of(q)); },
          [of](Question& q, S text) { return take(of(q), text); },
          [of](Question& q) {
            const Question begun;
            of(q) = of(begun);
          }};
}

template <class Of>
Member own_member(S name, S unit, S help, void (*apply)(RunConfig&, S), Of of) {
  Member own = member(name, of);
  own.unit = unit;
  own.help = help;
  own.apply = apply;
  return own;
}

Member wall_member() {
  return {"wall",
          [](const Question& q) { return q.domain.wall.empty() ? said(q.domain.wall_mm) : q.domain.wall; },
          [](Question& q, S text) {
            q.domain.wall = take(q.domain.wall_mm, text) ? "" : text;
            return true;
          },
          [](Question& q) {
            q.domain.wall_mm = DomainSpec().wall_mm;
            q.domain.wall.clear();
          }};
}

/// A radius, or a radius and a height; a height alone is a word of its own.
Member tip_member() {
  return {"tip", [](const Question& q) { return said(q.pose.tip); },
          [](Question& q, S text) {
            const auto parts = field_text::split(text, ',');
            return take(q.pose.tip, parts[0]) && (parts.size() == 1 || take(q.pose.tip_height, parts[1]));
          },
          [](Question& q) { q.pose.tip.reset(); }};
}

Member certify_member() {
  Member certify = member(
      "certify", [](auto& q) -> auto& { return q.certify; });
  certify.text = [](const Question& q) { return q.certify == 0 ? "" : said(q.certify); };
  return certify;
}

/// In an order in which they can be set: which direction is found goes by the problem, and a tip is a radius
/// before it has a height.
const std::vector<Member>& members() {
  static const std::vector<Member> all = {
      member(
          "problem", [](auto& q) -> auto& { return q.problem.name; }),
      member(
          "formulation", [](auto& q) -> auto& { return q.formulation.name; }),
      member(
          "solver", [](auto& q) -> auto& { return q.solver.name; }),
      member(
          "domain", [](auto& q) -> auto& { return q.domain.kind; }),
      member(
          "axis", [](auto& q) -> auto& { return q.pose.axis; }),
      member(
          "up", [](auto& q) -> auto& { return q.pose.up; }),
      member(
          "contact", [](auto& q) -> auto& { return q.pose.contact; }),
      member(
          "size", [](auto& q) -> auto& { return q.pose.size; }),
      member(
          "stem", [](auto& q) -> auto& { return q.pose.stem; }),
      tip_member(),
      own_member(
          "tip-height", "mm", "of the cone at the stem's end, whatever its radius",
          [](RunConfig& config, S text) {
            config.body.stem.tip_height = field_text::number("tip_height", text);
          },
          [](auto& q) -> auto& { return q.pose.tip_height; }),
      member(
          "flatten", [](auto& q) -> auto& { return q.pose.flatten; }),
      own_member(
          "find", "", "in place of axis or up, whichever the problem goes by: auto, near:x,y,z or rest:N",
          [](RunConfig& config, S text) {
            set_field(config, find_problem(config.problem).upright ? "up" : "axis", text);
          },
          [](auto& q) -> auto& { return q.pose.find; }),
      member(
          "axle", [](auto& q) -> auto& { return q.pose.axle; }),
      member(
          "slot", [](auto& q) -> auto& { return q.pose.slot; }),
      member(
          "axle-depth", [](auto& q) -> auto& { return q.pose.axle_depth; }),
      member(
          "density", [](auto& q) -> auto& { return q.densities.shell; }),
      member(
          "interior-density", [](auto& q) -> auto& { return q.densities.interior; }),
      member(
          "void-density", [](auto& q) -> auto& { return q.densities.filling; }),
      member(
          "resolution", [](auto& q) -> auto& { return q.domain.cells; }),
      wall_member(),
      certify_member(),
  };
  return all;
}

const Member* find_member(S name) {
  const auto found = std::ranges::find(members(), name, &Member::name);
  return found == members().end() ? nullptr : &*found;
}

void apply(const Member& member, RunConfig& config, S text) {
  if (member.apply)
    member.apply(config, text);
  else
    set_field(config, member.name, text);
}

/// Of a solve, but not of a question: how the body and the device come about, of which a session has its own;
/// and what a run is besides its result.
constexpr auto of_others =
    std::to_array<S>({"model", "unit", "weld", "close-holes", "inside-out", "pieces", "fineness", "device",
                      "precision", "part", "repeat", "budget", "memory", "seconds"});

std::string keyword_of(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

bool is_asked(const Field<RunConfig>& field) {
  return std::ranges::find(of_others, field.name) == of_others.end();
}

/// The field of that name, or of that keyword. @throws InputError  none
S name_of(const std::string& said) {
  if (std::ranges::find(of_others, said) != of_others.end())
    throw InputError(fmt::format(
        "{}: a question has no such field; expected where its body or device comes from, or of `bench`",
        said));
  std::vector<std::string> keywords;
  for (const QuestionField& field : question_fields()) {
    if (field.keyword == "cells" && said == field.keyword) return "resolution";
    if (field.name == said || field.keyword == said) return field.name;
    keywords.push_back(field.keyword);
  }
  throw unknown_name("field", said, keywords);
}

/// @throws InputError  a value that the field refuses, but for the one that it begins with: 0 is no
/// certificate
void check(const Field<RunConfig>& field, RunConfig checked, S name, S text) {
  if (text != field.text(checked)) field.set(checked, name, text);
}

/// What has a group: the problem's and the formulation's apart, those of solvers with it.
void set_choice(Question& question, S name, const std::string& text) {
  Asked checked;
  set_setting(checked, name, text);
  const S group = name.substr(0, name.find('.')), rest = name.substr(group.size() + 1);
  if (group == "problem")
    question.problem.settings[std::string(rest)] = text;
  else if (group == "formulation")
    question.formulation.settings[std::string(rest)] = text;
  else
    question.solver.settings[std::string(name)] = text;
}

}  // namespace

RunConfig config_of(const Question& question) {
  RunConfig config;
  for (const Member& member : members())
    if (const std::string text = member.text(question); !text.empty()) apply(member, config, text);
  const std::string solver = solver_of(config);
  for (const auto& [group, choice] : {std::pair<std::string, const Choice&>{"problem", question.problem},
                                      {"formulation", question.formulation},
                                      {solver, question.solver}})
    for (const auto& [name, value] : choice.settings) {
      // Settings of every solver stand beside those of the one in use: solver.start, ipopt.max_iter.
      const bool whole = name.find('.') != std::string::npos;
      set_field(config, whole ? name : group + "." + name, value);
    }
  for (const auto& [name, text] : question.fields)
    set_field(config, is_setting(name) ? S(name) : name_of(name), text);
  return config;
}

}  // namespace core

const std::vector<QuestionField>& question_fields() {
  static const std::vector<QuestionField> all = [] {
    std::vector<QuestionField> fields;
    const core::RunConfig here = core::config_of(Question()), there;
    for (const auto& field : core::solve_fields()) {
      if (!core::is_asked(field)) continue;
      const std::string usual = field.text(here);
      fields.push_back({std::string(field.name), core::keyword_of(option_of(field)), std::string(field.unit),
                        std::string(field.help) +
                            (usual == field.text(there) ? "" : fmt::format("; of a question {}", usual))});
    }
    for (const core::Member& member : core::members())
      if (member.apply)
        fields.push_back({std::string(member.name), core::keyword_of(std::string(member.name)),
                          std::string(member.unit), std::string(member.help)});
    fields.push_back({"cells", "cells", "", "the same as resolution"});
    return fields;
  }();
  return all;
}

void set_field(Question& question, const std::string& said, const std::string& text) {
  if (core::is_setting(said)) return core::set_choice(question, said, text);
  const std::string name(core::name_of(said));
  if (name.find('.') != std::string::npos) return core::set_choice(question, name, text);
  const core::Member* member = core::find_member(name);
  if (!text.empty()) {
    core::RunConfig checked;
    checked.problem = question.problem.name;
    if (member && member->apply)
      member->apply(checked, text);
    else
      core::check(*find_field(core::solve_fields(), name), checked, said, text);
  }
  question.fields.erase(name);
  if (name == "resolution") question.fields.erase("level");  // says the same in other words
  if (member && !text.empty() && member->take(question, text)) return;
  if (member) member->forget(question);
  if (!text.empty()) question.fields[name] = text;
}

std::string text_of(const Question& question, const std::string& said) {
  const std::string name(core::name_of(said));
  if (const auto* field = find_field(core::solve_fields(), name))
    return field->text(core::config_of(question));
  return core::find_member(name)->text(question);
}

}  // namespace kreisel
