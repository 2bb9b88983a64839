// words.hpp - several words as one text and back, though a word may have a space in it; a word as a shell
// reads it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kreisel::core {

/// Words with a space between them; a space or backslash within a word has a backslash before it.
[[nodiscard]] inline std::string joined_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    for (const char c : word) {
      if (c == ' ' || c == '\\') text += '\\';
      text += c;
    }
  }
  return text;
}

/// The words again. Spaces between them may be several.
[[nodiscard]] inline std::vector<std::string> split_words(std::string_view text) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == ' ' || text[i + 1] == '\\'))
      words.back() += text[++i];
    else if (text[i] != ' ')
      words.back() += text[i];
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// One word as a shell reads it: quoted where it would read anything else.
[[nodiscard]] inline std::string shell_word(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\n'\"\\$`&|;<>()*?[]#~!{}") == std::string::npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace kreisel::core
