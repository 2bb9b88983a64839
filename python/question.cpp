#include "question.hpp"

#include <charconv>
#include <sstream>

namespace kreisel::python {

std::string text_of(const py::handle& value) {
  return py::isinstance<py::str>(value) ? value.cast<std::string>() : py::repr(value).cast<std::string>();
}

std::string field_text(const py::handle& value, char between) {
  if (PyFloat_Check(value.ptr())) return text_of(py::float_(value.cast<double>()));  // numpy's repr has more
  if (py::isinstance<py::str>(value) || PyLong_Check(value.ptr())) return text_of(value);
  if (py::hasattr(value, "tolist")) return field_text(value.attr("tolist")(), between);
  if (!py::isinstance<py::sequence>(value)) return text_of(value);
  std::string text;
  for (const py::handle part : value) {
    if (!text.empty()) text += between;
    text += field_text(part);
  }
  return text;
}

namespace {

void set_settings(Question& q, const py::handle& value) {
  q.problem.settings.clear();
  q.formulation.settings.clear();
  q.solver.settings.clear();
  for (const auto& [name, text] : value_of<py::dict>("settings", value, "a dict")) {
    const std::string key = name.cast<std::string>();
    if (key.find('.') == std::string::npos)
      throw InputError("settings: '" + key + "'; expected GROUP.NAME, such as problem.draft");
    set_field(q, key, field_text(text));
  }
}

/// None is said of what says nothing by itself.
void set_keyword(Question& q, const std::string& key, const py::handle& value) {
  if (key == "settings") return set_settings(q, value);
  const bool of_cells = key == "cells" || key == "resolution";
  const bool nothing = value.is_none() && text_of(Question(), key).empty();
  set_field(q, key, nothing ? "" : field_text(value, of_cells ? 'x' : ','));
}

/// All of it; None where it is none.
py::object number_of(const std::string& text) {
  double value{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return py::none();
  const bool whole = text.find_first_not_of("-0123456789") == std::string::npos;
  return whole ? py::object(py::int_(static_cast<long long>(value))) : py::object(py::float_(value));
}

}  // namespace

Question replaced(Question question, const py::kwargs& fields) {
  // Settings of what is replaced go with it, ahead of those that are given; the problem is what others go by.
  if (fields.contains("problem")) {
    question.problem.settings.clear();
    set_keyword(question, "problem", fields["problem"]);
  }
  if (fields.contains("formulation")) question.formulation.settings.clear();
  if (fields.contains("solver")) question.solver.settings.clear();
  if (fields.contains("settings")) set_settings(question, fields["settings"]);
  for (const auto& [key, value] : fields)
    if (const auto name = key.cast<std::string>(); name != "problem" && name != "settings")
      set_keyword(question, name, value);
  return question;
}

Question question_of(const py::object& asked, const py::kwargs& fields) {
  if (py::isinstance<Question>(asked)) return replaced(asked.cast<Question>(), fields);
  Question question;
  set_field(question, "problem", value_of<std::string>("problem", asked, "a name, or a Question"));
  return replaced(std::move(question), fields);
}

py::object value_of_text(const std::string& text) {
  if (text.empty()) return py::none();
  if (py::object number = number_of(text); !number.is_none()) return number;
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const py::object number = number_of(part);
    if (number.is_none()) return py::str(text);
    numbers.push_back(number.cast<double>());
  }
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

std::string doc_of_questions() {
  std::string doc =
      "What may be asked of a body. Immutable: replace() gives another.\n\n"
      "Keywords, each a number, text, or a sequence:\n"
      "    settings: a dict of what has no keyword, GROUP.NAME: {'ipopt.max_iter': 500}\n";
  for (const QuestionField& field : question_fields())
    doc += "    " + field.keyword + ": " + help_of(field) + "\n";
  return doc;
}

std::string help_of(const QuestionField& field) {
  return (field.unit.empty() ? "" : "[" + field.unit + "] ") + field.help;
}

std::string repr_of(const Question& q) {
  return "Question(problem='" + q.problem.name + "', formulation='" + q.formulation.name +
         "', cells=" + std::to_string(q.domain.cells[0]) +
         ", wall=" + (q.domain.wall.empty() ? std::to_string(q.domain.wall_mm) : "'" + q.domain.wall + "'") +
         ")";
}

}  // namespace kreisel::python
