#include "record/summary.hpp"

#include <algorithm>
#include <mutex>
#include <set>
#include <utility>

#include "parse.hpp"

namespace kreisel::core {

namespace {

/// The one copy of these names. Never taken back: there are as many as kinds of records.
const std::vector<std::string>* shared(std::vector<std::string> names) {
  static std::mutex adding;
  static std::set<std::vector<std::string>> all;  // whose nodes stay where they are
  const std::scoped_lock lock(adding);
  return &*all.insert(std::move(names)).first;
}

}  // namespace

Summary::Summary(const nlohmann::json& object) {
  if (!object.is_object()) return;
  Names names;
  std::vector<std::uint8_t> bytes;
  for (auto item = object.begin(); item != object.end(); ++item) {  // sorted by name
    names.push_back(item.key());
    begins_.push_back(static_cast<std::uint32_t>(bytes.size()));
    nlohmann::json::to_cbor(item.value(), bytes);
  }
  begins_.push_back(static_cast<std::uint32_t>(bytes.size()));
  begins_.shrink_to_fit();
  names_ = shared(std::move(names));
  bytes_.assign(bytes.begin(), bytes.end());
}

nlohmann::json Summary::unpacked(std::size_t index) const {
  return nlohmann::json::from_cbor(bytes_.begin() + begins_[index], bytes_.begin() + begins_[index + 1]);
}

nlohmann::json Summary::at(std::string_view path) const {
  if (!names_) return nullptr;
  const std::size_t dot = std::min(path.find('.'), path.size());
  const std::string_view first = path.substr(0, dot);
  const auto found = std::ranges::lower_bound(*names_, first);
  if (found == names_->end() || *found != first) return nullptr;
  return value_in(unpacked(static_cast<std::size_t>(found - names_->begin())),
                  path.substr(std::min(dot + 1, path.size())));
}

nlohmann::json Summary::whole() const {
  nlohmann::json object = nlohmann::json::object();
  for (std::size_t i = 0; names_ && i < names_->size(); ++i) object[(*names_)[i]] = unpacked(i);
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
