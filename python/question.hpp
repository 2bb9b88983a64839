// question.hpp - questions from keywords.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <kreisel/kreisel.hpp>
#include <string>

namespace kreisel::python {

namespace py = pybind11;

/// A value as messages show it.
[[nodiscard]] std::string text_of(const py::handle& value);

/// A number as text, or several of them, as fields are written: "60", "0,0,1".
[[nodiscard]] std::string field_text(const py::handle& value, char between = ',');

/// The way back: None, a number, an array of them, or text.
[[nodiscard]] py::object value_of_text(const std::string& text);

/// @throws InputError  a value of another type
template <class T>
T value_of(const std::string& key, const py::handle& value, const char* expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw InputError(key + " = " + text_of(value) + "; expected " + expected);
  }
}

/// The same but for the fields given. @throws InputError  no such field, a value of another type
[[nodiscard]] Question replaced(Question question, const py::kwargs& fields);

/// A question, or the name of its problem, and what differs from it.
[[nodiscard]] Question question_of(const py::object& asked, const py::kwargs& fields);

/// "[mm] radius of a peg to spin on".
[[nodiscard]] std::string help_of(const QuestionField& field);
/// Of the class: every keyword.
[[nodiscard]] std::string doc_of_questions();

[[nodiscard]] std::string repr_of(const Question& question);

}  // namespace kreisel::python
