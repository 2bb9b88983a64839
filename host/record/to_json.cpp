#include "record/to_json.hpp"

#include <algorithm>

namespace kreisel::core::fields {

using nlohmann::json;

json& place(json& root, std::string_view path) {
  json* at = &root;
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

json plain(const json& value) {
  return json::parse(value.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace kreisel::core::fields
