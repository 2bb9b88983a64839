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

/// How finely a text writes its coordinates.
class Digits {
 public:
  /// A number that was read.
  void see(std::string_view number);
  /// What two numbers of the size of the largest coordinate may differ by and be the same but for their last
  /// digit; as a distance, for it may be so in every coordinate.
  ///
  /// One unit of the last place, where all numbers have the same number of decimals; else what the longest of
  /// them has, or six digits, which is what programs write that do not write more. Never more than a
  /// thousandth of the largest: two decimals of an inch are no precision.
  [[nodiscard]] double weld(double largest) const;

 private:
  int most_ = 0;                              ///< significant digits
  int fewest_decimals_ = -1, decimals_ = -1;  ///< least and most; -1: none seen
  bool powers_ = false;                       ///< some number has an exponent
};

/// The same of numbers in single or double precision. @param bits  of the mantissa: 24 or 53
[[nodiscard]] double weld_of_binary(double largest, int bits);

/// The largest coordinate, by its size. 0 without vertices.
[[nodiscard]] double largest_coordinate(const TriangleMesh& mesh);

/// The next word of `line`, cut from its front; empty at the end. Blanks, tabs and line ends separate.
[[nodiscard]] std::string_view next_word(std::string_view& line);

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
