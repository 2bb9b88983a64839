#include "live/pages.hpp"

#include <array>
#include <utility>
#include <vector>

namespace kreisel::core::live {
namespace {

std::string_view type_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> types = {
      {{".html", "text/html; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"},
       {".svg", "image/svg+xml"}}};
  for (const auto& [end, type] : types)
    if (name.ends_with(end)) return type;
  return "application/octet-stream";
}

}  // namespace

const PageFile* find_page(std::string_view name) {
  static const std::vector<PageFile> files = [] {
    std::vector<PageFile> all;
    for (const Embedded* file = embedded_pages; *file->name; ++file)
      all.push_back({file->name, type_of(file->name), {file->text, file->size}});
    return all;
  }();
  if (name.empty()) name = "index.html";
  for (const PageFile& file : files)
    if (file.name == name) return &file;
  return nullptr;
}

}  // namespace kreisel::core::live
