#include "print/slice/profile.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "error.hpp"
#include "print/gcode/remark.hpp"

namespace kreisel::core {

SlicerSettings parse_profile(std::string_view text, const std::string& name) {
  SlicerSettings settings;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (line.empty() || line[0] == '#' || line[0] == ';') continue;
    const std::size_t equals = line.find('=');
    const std::string_view key = trimmed(line.substr(0, equals));
    if (equals == std::string_view::npos || key.empty() || line.find('\0') != std::string_view::npos)
      throw InputError(fmt::format("{}: line {}: no setting, expected key = value", name, number));
    settings[std::string(key)] = trimmed(line.substr(equals + 1));
  }
  return settings;
}

SlicerSettings read_profile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(
        fmt::format("--profile {}: cannot be read, expected a file of key = value", file.string()));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return parse_profile(text, file.string());
}

std::string profile_text(const SlicerSettings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += fmt::format("{} = {}\n", key, value);
  return text;
}

}  // namespace kreisel::core
