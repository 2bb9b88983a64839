// pages.hpp - the files of the page, in the program.
#pragma once

#include <cstddef>
#include <string_view>

namespace kreisel::core::live {

struct PageFile {
  std::string_view name, type, text;
};

/// The file of that name, or nullptr. "" is the page itself.
[[nodiscard]] const PageFile* find_page(std::string_view name);

/// Made from host/live/page by cmake/embed_files.cmake; ends with a name that is empty.
struct Embedded {
  const char *name, *text;
  std::size_t size;
};
extern const Embedded embedded_pages[];

}  // namespace kreisel::core::live
