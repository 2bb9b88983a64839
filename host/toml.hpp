// toml.hpp - TOML, by toml++, from which nothing in a text ends the program.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "error.hpp"

namespace kreisel::core {

/// Something that toml++ takes for granted does not hold of the text.
struct TomlDoubt {};
[[noreturn]] inline void throw_toml_doubt() { throw TomlDoubt(); }

}  // namespace kreisel::core

// As assertions these end the program on "[=]". With NDEBUG the compiler would take them for true, and what
// such a text does be undefined.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) (static_cast<bool>(expr) ? void() : kreisel::core::throw_toml_doubt())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace kreisel::core {

/// @param name  of the file, for messages
/// @throws InputError  it is no TOML; says in which line
[[nodiscard]] inline toml::table parse_toml(std::string_view text, const std::string& name) {
  const auto refusal = [&](std::size_t line, std::string what) {
    std::ranges::replace(what, '\n', ' ');
    return InputError(fmt::format("{}: line {}: {}, expected TOML", name, line, what));
  };
  const auto in_doubt = [](std::string_view part) {
    try {
      (void)toml::parse(part);
    } catch (const TomlDoubt&) {
      return true;
    } catch (const toml::parse_error&) {
    }
    return false;
  };
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw refusal(error.source().begin.line, std::string(error.description()));
  } catch (const TomlDoubt&) {
    // It does not say where: in the last line of the shortest text that is as bad.
    std::size_t line = 1, end = text.find('\n');
    for (; end != text.npos && !in_doubt(text.substr(0, end + 1)); end = text.find('\n', end + 1)) ++line;
    throw refusal(line, "no name of a table or key");
  }
}

}  // namespace kreisel::core
