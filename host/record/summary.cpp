#include "record/summary.hpp"

#include <algorithm>
#include <mutex>
#include <set>

#include "parse.hpp"

namespace kreisel::core {

namespace {

/// The one copy of a name. Never taken back: there are as many as a summary has values.
const std::string* shared(const std::string& name) {
  static std::mutex adding;
  static std::set<std::string> names;  // whose nodes stay where they are
  const std::scoped_lock lock(adding);
  return &*names.insert(name).first;
}

}  // namespace

Summary::Summary(const nlohmann::json& object) {
  if (!object.is_object()) return;
  std::vector<std::uint8_t> bytes;
  for (auto item = object.begin(); item != object.end(); ++item) {  // sorted by name
    const auto begin = static_cast<std::uint32_t>(bytes.size());
    nlohmann::json::to_cbor(item.value(), bytes);
    entries_.push_back({shared(item.key()), begin, static_cast<std::uint32_t>(bytes.size())});
  }
  entries_.shrink_to_fit();
  bytes_.assign(bytes.begin(), bytes.end());
}

nlohmann::json Summary::unpacked(const Entry& entry) const {
  return nlohmann::json::from_cbor(bytes_.begin() + entry.begin, bytes_.begin() + entry.end);
}

nlohmann::json Summary::at(std::string_view path) const {
  const std::size_t dot = std::min(path.find('.'), path.size());
  const std::string_view first = path.substr(0, dot);
  const auto found =
      std::ranges::lower_bound(entries_, first, {}, [](const Entry& e) { return std::string_view(*e.name); });
  if (found == entries_.end() || *found->name != first) return nullptr;
  return value_in(unpacked(*found), path.substr(std::min(dot + 1, path.size())));
}

nlohmann::json Summary::whole() const {
  nlohmann::json object = nlohmann::json::object();
  for (const Entry& entry : entries_) object[*entry.name] = unpacked(entry);
  return object;
}

nlohmann::json value_in(const nlohmann::json& summary, std::string_view name) {
  const nlohmann::json* at = &summary;
  while (!name.empty()) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    const std::string word(name.substr(0, dot));
    name.remove_prefix(std::min(dot + 1, name.size()));
    if (at->is_object() && at->contains(word))
      at = &at->at(word);
    else if (const auto index = parse<std::size_t>(word); at->is_array() && index && *index < at->size())
      at = &at->at(*index);
    else
      return nullptr;
  }
  return *at;
}

}  // namespace kreisel::core
