// text.hpp - a mesh file as text: words, numbers, and errors that know file and line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "error.hpp"
#include "geometry/triangle_mesh.hpp"
#include "mesh/io/mesh_file.hpp"

namespace kreisel::core {

/// The bytes of the file without a byte order mark of UTF-8. @throws InputError  text in UTF-16, says so
[[nodiscard]] std::string_view text_of(const MeshFile& file);

/// A word of a file for a message: no control characters (the file may be anything), and not too long.
[[nodiscard]] std::string shown(std::string_view word);

/// ASCII letters alone.
[[nodiscard]] std::string lower_case(std::string_view word);

/// The first line of `rest`, cut from its front with its end: LF, CR LF or CR.
[[nodiscard]] std::string_view cut_line(std::string_view& rest);

/// The next word of `line`, cut from its front; empty at the end. Blanks, tabs and line ends separate.
[[nodiscard]] std::string_view next_word(std::string_view& line);

/// What numbers in binary, of the size of the largest coordinate, may differ by and be the same but for their
/// last digits: four steps, for arithmetic in that precision adds a few. @param bits  of the mantissa
[[nodiscard]] double weld_of_binary(double largest, int bits);

/// How finely a file writes its coordinates.
class Digits {
 public:
  /// A coordinate, as it was written in text and as it was read.
  void see(std::string_view number, double value);
  /// A coordinate of a binary file in double.
  void see(double value);

  /// The same of these coordinates; as a distance, for they may differ so in every direction.
  ///
  /// Numbers that are all floats are that: in double or with many digits, they are a program's that has
  /// floats. Else of text: sqrt(3) units of the last place, where all have the same number of decimals; or
  /// else of what the longest has, but six digits at least, which is what programs write that do not write
  /// more. No less than of doubles, or of floats where nine digits, which those take, are most. A unit is no
  /// more than 1e-4 of the largest: two decimals of an inch are no round-off; nor are whole numbers.
  [[nodiscard]] double weld(double largest) const;

 private:
  int most_ = 0;                              ///< significant digits
  int fewest_decimals_ = -1, decimals_ = -1;  ///< least and most; -1: no text seen
  bool powers_ = false;                       ///< some number has an exponent
  bool floats_ = true;                        ///< every one is a float
};

/// The largest coordinate, by its size. 0 without vertices.
[[nodiscard]] double largest_coordinate(const TriangleMesh& mesh);

/// Walks the words of a text; `#` starts a comment that ends with its line.
class Words {
 public:
  explicit Words(const MeshFile& file) : name_(&file.name), rest_(text_of(file)) {}

  /// The next word, in this line or a later one; empty at the end of the file.
  std::string_view next();
  /// The next word of the line of the last one; empty at its end.
  std::string_view next_in_line();
  /// Goes on with the line behind that of the last word.
  void skip_line();
  /// Whether the file has no more words.
  [[nodiscard]] bool ended() const;

  /// Three finite coordinates; `index` (from 1) names the vertex in the error.
  /// @param in_line  all in one line
  Vec3 point(std::size_t index, Digits& digits, bool in_line);

  /// An error at the line of the last word.
  [[nodiscard]] InputError error(std::string_view what) const;

 private:
  void skip_blanks_and_comment();

  const std::string* name_;
  std::string_view rest_;
  std::size_t line_ = 1, at_ = 1;  ///< under way; of the last word
};

}  // namespace kreisel::core
