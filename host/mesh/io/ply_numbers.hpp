// ply_numbers.hpp - what stands behind the header of a PLY file.
#pragma once

#include "error.hpp"
#include "mesh/io/ply_header.hpp"
#include "mesh/io/text.hpp"
#include "stop.hpp"

namespace kreisel::core::ply {

/// The numbers behind the header, one after the other. Double holds every PLY type exactly.
class Numbers {
 public:
  Numbers(const MeshFile& file, const Header& header)
      : file_(file), encoding_(header.encoding), rest_(header.body) {}

  /// Names what is being read, for the errors. @throws Interrupted  a stop was asked for
  void at(const Element& element, std::uint64_t index) {
    stop_here();
    element_ = &element;
    index_ = index;
  }

  /// @throws InputError  the end of the file; in text, no finite number
  double next(Type type);
  /// The same, of a coordinate: its digits count. @throws InputError  as next(); not finite
  double coordinate(const Property& property);
  /// Passes over a number or a list, whose values are not judged. @throws InputError  the end of the file
  void skip(const Property& property);
  /// The length of a list that follows. @throws InputError  as next(); no whole number of 0 or more
  std::size_t list_length(const Property& property);

  /// @throws InputError  more bytes than blanks
  void require_end();

  /// An error at what is being read.
  [[nodiscard]] InputError error(std::string_view what) const;

  /// Of the coordinates.
  [[nodiscard]] const Digits& digits() const { return digits_; }

 private:
  std::string_view text_word();
  [[nodiscard]] InputError cut_off() const;
  double from_text();
  double from_bytes(Type type);

  const MeshFile& file_;
  Encoding encoding_;
  std::string_view rest_;
  const Element* element_ = nullptr;
  std::uint64_t index_ = 0;
  Digits digits_;
  std::string_view last_word_;  ///< of text
};

}  // namespace kreisel::core::ply
