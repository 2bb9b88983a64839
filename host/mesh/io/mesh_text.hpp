// mesh_text.hpp - a mesh file in memory, read line by line, word by word; errors know file and line.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "error.hpp"
#include "geometry/triangle_mesh.hpp"
#include "parse.hpp"

namespace kreisel::core {

/// A whole file and the name it goes by in messages.
struct MeshFile {
  std::string name;
  std::string bytes;
};

/// The next word of `line`, cut from its front; empty at the end. Blanks, tabs and carriage returns separate.
inline std::string_view next_word(std::string_view& line) {
  constexpr std::string_view blank = " \t\r\v\f";
  const std::size_t first = std::min(line.find_first_not_of(blank), line.size());
  line.remove_prefix(first);
  const std::string_view word = line.substr(0, line.find_first_of(blank));
  line.remove_prefix(word.size());
  return word;
}

/// A word of a file for a message: no control characters (the file may be anything), and not too long.
inline std::string shown(std::string_view word) {
  constexpr std::size_t most = 40;
  std::string text(word.substr(0, most));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > most ? text + "..." : text;
}

/// Walks the lines of a file that have at least one word; `#` starts a comment.
class MeshLines {
 public:
  explicit MeshLines(const MeshFile& file) : file_(file), rest_(file.bytes) {}

  /// Moves to the next line with content; false at the end of the file.
  bool next(std::string_view& line) {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line = rest_.substr(0, end);
      line = line.substr(0, line.find('#'));  // not in rest_, which would be searched to its end every time
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      std::string_view probe = line;
      if (!next_word(probe).empty()) return true;
    }
    return false;
  }

  /// An error at the current line.
  [[nodiscard]] InputError error(std::string_view what) const {
    return InputError(fmt::format("{}: line {}: {}", file_.name, number_, what));
  }

  /// Three finite coordinates from the front of `line`; `index` (from 1) names the vertex in the error.
  Vec3 point(std::string_view& line, std::size_t index) const {
    Vec3 p;
    for (double& x : p) {
      const std::string_view word = next_word(line);
      const auto value = parse<double>(word);
      if (!value)
        throw error(
            fmt::format("coordinate '{}' of vertex {}, expected three finite numbers", shown(word), index));
      x = *value;
    }
    return p;
  }

 private:
  const MeshFile& file_;
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Appends a polygon of at least three corners as a fan about its first.
template <class Corners>
void add_fan(TriangleMesh& mesh, const Corners& corners) {
  for (std::size_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

}  // namespace kreisel::core
