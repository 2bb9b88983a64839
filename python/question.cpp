#include "question.hpp"

#include <array>
#include <map>
#include <optional>

namespace kreisel::python {

std::string text_of(const py::handle& value) {
  return py::isinstance<py::str>(value) ? value.cast<std::string>() : py::repr(value).cast<std::string>();
}

std::string field_text(const py::handle& value) {
  if (!py::isinstance<py::sequence>(value) || py::isinstance<py::str>(value)) {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) return text_of(value);
    if (py::hasattr(value, "tolist")) return field_text(value.attr("tolist")());
    return text_of(value);
  }
  std::string text;
  for (const py::handle part : value) text += (text.empty() ? "" : ",") + text_of(part);
  return text;
}

namespace {

void set_cells(Question& q, const py::handle& value) {
  if (py::isinstance<py::int_>(value) || py::hasattr(value, "__index__"))
    q.domain.cells = {value_of<int>("cells", value, "a whole number, or three"), 0, 0};
  else
    q.domain.cells = value_of<std::array<int, 3>>("cells", value, "a whole number, or three");
}

void set_wall(Question& q, const py::handle& value) {
  const bool text = py::isinstance<py::str>(value);
  q.domain.wall = text ? value.cast<std::string>() : "";
  if (!text) q.domain.wall_mm = value_of<double>("wall", value, "mm, or text: \"2%\", \"1.5h\"");
}

void set_settings(Question& q, const py::handle& value) {
  q.problem.settings.clear();
  q.formulation.settings.clear();
  q.solver.settings.clear();
  for (const auto& [name, text] : value_of<py::dict>("settings", value, "a dict")) {
    const std::string key = name.cast<std::string>();
    const std::size_t dot = key.find('.');
    const std::string group = key.substr(0, dot), rest = dot == std::string::npos ? "" : key.substr(dot + 1);
    if (rest.empty()) throw InputError("settings: '" + key + "'; expected GROUP.NAME, such as problem.draft");
    if (group == "problem")
      q.problem.settings[rest] = field_text(text);
    else if (group == "formulation")
      q.formulation.settings[rest] = field_text(text);
    else
      q.solver.settings[key] = field_text(text);
  }
}

using Setter = void (*)(Question&, const py::handle&);
using Optional = std::optional<double>;

const std::map<std::string, Setter>& setters() {
  using H = const py::handle&;
  static const std::map<std::string, Setter> all = {
      {"problem", [](Question& q, H v) { q.problem.name = value_of<std::string>("problem", v, "a name"); }},
      {"formulation",
       [](Question& q, H v) { q.formulation.name = value_of<std::string>("formulation", v, "a name"); }},
      {"solver", [](Question& q, H v) { q.solver.name = value_of<std::string>("solver", v, "a name"); }},
      {"domain", [](Question& q, H v) { q.domain.kind = value_of<std::string>("domain", v, "a name"); }},
      {"settings", set_settings},
      {"axis",
       [](Question& q, H v) { q.pose.axis = value_of<std::optional<Vec3>>("axis", v, "three numbers"); }},
      {"up", [](Question& q, H v) { q.pose.up = value_of<std::optional<Vec3>>("up", v, "three numbers"); }},
      {"contact",
       [](Question& q, H v) {
         q.pose.contact = value_of<std::optional<Vec3>>("contact", v, "three numbers, mm");
       }},
      {"find",
       [](Question& q, H v) {
         q.pose.find = value_of<std::string>("find", v, "text: auto, near:x,y,z or rest:N");
       }},
      {"stem", [](Question& q, H v) { q.pose.stem = value_of<Optional>("stem", v, "mm"); }},
      {"tip", [](Question& q, H v) { q.pose.tip = value_of<Optional>("tip", v, "mm"); }},
      {"tip_height", [](Question& q, H v) { q.pose.tip_height = value_of<Optional>("tip_height", v, "mm"); }},
      {"flatten", [](Question& q, H v) { q.pose.flatten = value_of<Optional>("flatten", v, "mm"); }},
      {"size", [](Question& q, H v) { q.pose.size = value_of<Optional>("size", v, "mm"); }},
      {"axle", [](Question& q, H v) { q.pose.axle = value_of<Optional>("axle", v, "mm"); }},
      {"slot", [](Question& q, H v) { q.pose.slot = value_of<Optional>("slot", v, "mm"); }},
      {"axle_depth", [](Question& q, H v) { q.pose.axle_depth = value_of<Optional>("axle_depth", v, "mm"); }},
      {"density", [](Question& q, H v) { q.densities.shell = value_of<double>("density", v, "g/cm^3"); }},
      {"interior_density",
       [](Question& q, H v) { q.densities.interior = value_of<Optional>("interior_density", v, "g/cm^3"); }},
      {"void_density",
       [](Question& q, H v) { q.densities.filling = value_of<double>("void_density", v, "g/cm^3"); }},
      {"wall", set_wall},
      {"cells", set_cells},
      {"certify",
       [](Question& q, H v) { q.certify = value_of<double>("certify", v, "a gap, such as 1e-3"); }},
  };
  return all;
}

}  // namespace

Question replaced(Question question, const py::kwargs& fields) {
  // Settings of what is replaced go with it, ahead of those that are given.
  if (fields.contains("problem")) question.problem.settings.clear();
  if (fields.contains("formulation")) question.formulation.settings.clear();
  if (fields.contains("solver")) question.solver.settings.clear();
  for (const auto& [key, value] : fields) {
    const auto setter = setters().find(key.cast<std::string>());
    if (setter == setters().end()) {
      std::string names;
      for (const auto& [name, unused] : setters()) names += (names.empty() ? "" : ", ") + name;
      throw InputError("question: no field '" + key.cast<std::string>() + "'; expected one of: " + names);
    }
    setter->second(question, value);
  }
  return question;
}

Question question_of(const py::object& asked, const py::kwargs& fields) {
  if (py::isinstance<Question>(asked)) return replaced(asked.cast<Question>(), fields);
  Question question;
  question.problem.name = value_of<std::string>("problem", asked, "a name, or a Question");
  return replaced(std::move(question), fields);
}

std::string repr_of(const Question& q) {
  return "Question(problem='" + q.problem.name + "', formulation='" + q.formulation.name +
         "', cells=" + std::to_string(q.domain.cells[0]) +
         ", wall=" + (q.domain.wall.empty() ? std::to_string(q.domain.wall_mm) : "'" + q.domain.wall + "'") +
         ")";
}

}  // namespace kreisel::python
