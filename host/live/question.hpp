// question.hpp - what a request may ask of a body, by the names of the fields.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "error.hpp"
#include "session/config.hpp"

namespace kreisel::core::live {

/// The fields of a solve that a request may set: none that names a file, a device, a solver or its options.
[[nodiscard]] const Fields<RunConfig>& open_fields();

/// Those that say what body it is, ahead of any question: in what unit, and what may be mended.
[[nodiscard]] const Fields<RunConfig>& body_fields();

/// A question as it begins: the quadric, on rays cut at a wall of 1.2 mm.
[[nodiscard]] RunConfig usual_question();

/// A field's text in a request. @throws InputError  it is none
[[nodiscard]] std::string text_of_field(const std::string& name, const nlohmann::json& value);

/// What a page draws a control from. @param usual  the field's text where nobody says it
[[nodiscard]] nlohmann::json field_json(std::string_view name, std::string_view unit, std::string_view help,
                                        std::string_view group, const std::string& usual,
                                        const Choices& choices);

/// @param said  an object of texts, each by the name of its field
/// @throws InputError  a field that there is not, or is not allowed; a value that does not fit
template <class T>
void set_fields(T& run, const nlohmann::json& said, const Fields<T>& fields) {
  if (!said.is_object()) throw InputError("no fields; expected an object of texts by name");
  for (const auto& [name, value] : said.items()) set_field(fields, run, name, text_of_field(name, value));
}

template <class T>
[[nodiscard]] nlohmann::json fields_json(const Fields<T>& fields, const T& usual) {
  nlohmann::json all = nlohmann::json::array();
  for (const Field<T>& f : fields)
    all.push_back(field_json(f.name, f.unit, f.help, f.group, f.text(usual), f.choices));
  return all;
}

/// Every problem, and which of the fields count for it.
[[nodiscard]] nlohmann::json problems_json();

}  // namespace kreisel::core::live
