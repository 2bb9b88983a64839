#include "record/to_json.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kreisel::core::fields {

nlohmann::json& place(nlohmann::json& root, std::string_view path) {
  nlohmann::json* at = &root;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string word(path.substr(0, dot));
    path.remove_prefix(std::min(dot + 1, path.size()));
    if (word.find_first_not_of("0123456789") == std::string::npos)
      at = &(*at)[std::stoul(word)];
    else
      at = &(*at)[word];
  }
  return *at;
}

namespace {

bool is_ascii(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) { return c < 0x80; });
}

/// A text, or a name in the object, that may be no UTF-8.
bool has_odd_text(const nlohmann::json& value) {
  if (value.is_string()) return !is_ascii(value.get_ref<const std::string&>());
  if (!value.is_object()) return false;
  for (auto item = value.begin(); item != value.end(); ++item)
    if (!is_ascii(item.key())) return true;
  return false;
}

}  // namespace

nlohmann::json plain(nlohmann::json value) {
  if (has_odd_text(value))
    return nlohmann::json::parse(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  if (value.is_structured())
    for (nlohmann::json& item : value) item = plain(std::move(item));
  else if (value.is_number_float() && !std::isfinite(value.get<double>()))
    value = nullptr;
  return value;
}

}  // namespace kreisel::core::fields
