#include "record/summary.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
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

/// What nlohmann's parser comes across, as CBOR (RFC 8949). Lists and objects have no length but an end,
/// which is not known before.
class Summary::Packing final : public nlohmann::json_sax<nlohmann::json> {
 public:
  [[nodiscard]] Summary summary() && { return {std::move(values_), bytes_}; }

  bool null() override { return put_value(0xf6); }
  bool boolean(bool value) override { return put_value(value ? 0xf5 : 0xf4); }
  bool number_integer(number_integer_t value) override {
    if (value < 0) return put_number(0x20, static_cast<std::uint64_t>(-1 - value));
    return put_number(0x00, static_cast<std::uint64_t>(value));
  }
  bool number_unsigned(number_unsigned_t value) override { return put_number(0x00, value); }
  bool number_float(number_float_t value, const string_t&) override {
    constexpr double most = std::numeric_limits<float>::max();
    if (std::abs(value) <= most && static_cast<float>(value) == value)
      put(0xfa, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    else
      put(0xfb, std::bit_cast<std::uint64_t>(value));
    return ended();
  }
  bool string(string_t& value) override {
    put_text(value);
    return ended();
  }
  bool binary(binary_t&) override { return false; }  // JSON has none
  bool start_object(std::size_t) override { return begun(0xbf); }
  bool start_array(std::size_t) override { return begun(0x9f); }
  bool end_object() override { return --depth_ == 0 || put_value(0xff); }
  bool end_array() override { return --depth_ == 0 || put_value(0xff); }
  bool key(string_t& name) override {
    if (depth_ == 1)
      values_.push_back({std::move(name), size(), 0});
    else
      put_text(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(bytes_.size()); }
  /// The outermost object is not in the bytes. @return  false where the outermost is none
  bool begun(std::uint8_t head) {
    if (depth_ == 0 && head != 0xbf) return false;
    if (depth_++ > 0) bytes_.push_back(head);
    return true;
  }
  bool ended() {
    if (depth_ == 1) values_.back().ends = size();
    return depth_ > 0;
  }
  bool put_value(std::uint8_t byte) {
    bytes_.push_back(byte);
    return ended();
  }
  /// A head and its number, high byte first.
  template <class Unsigned>
  void put(int head, Unsigned number) {
    bytes_.push_back(static_cast<std::uint8_t>(head));
    for (int shift = 8 * (static_cast<int>(sizeof(number)) - 1); shift >= 0; shift -= 8)
      bytes_.push_back(static_cast<std::uint8_t>(number >> shift));
  }
  void put_head(int major, std::uint64_t number) {
    if (number < 24)
      bytes_.push_back(static_cast<std::uint8_t>(major | static_cast<int>(number)));
    else if (number <= 0xff)
      put(major | 0x18, static_cast<std::uint8_t>(number));
    else if (number <= 0xffff)
      put(major | 0x19, static_cast<std::uint16_t>(number));
    else if (number <= 0xffffffff)
      put(major | 0x1a, static_cast<std::uint32_t>(number));
    else
      put(major | 0x1b, number);
  }
  bool put_number(int major, std::uint64_t number) {
    put_head(major, number);
    return ended();
  }
  void put_text(const std::string& text) {
    put_head(0x60, text.size());
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }

  std::vector<Value> values_;
  std::vector<std::uint8_t> bytes_;
  int depth_ = 0;
};

Summary::Summary(std::vector<Value> values, const std::vector<std::uint8_t>& bytes) {
  std::ranges::sort(values, {}, &Value::name);
  Names names;
  bytes_.reserve(bytes.size());
  begins_.reserve(values.size() + 1);
  for (Value& value : values) {
    begins_.push_back(static_cast<std::uint32_t>(bytes_.size()));
    bytes_.insert(bytes_.end(), bytes.begin() + value.begins, bytes.begin() + value.ends);
    names.push_back(std::move(value.name));
  }
  begins_.push_back(static_cast<std::uint32_t>(bytes_.size()));
  names_ = shared(std::move(names));
}

Summary::Summary(const nlohmann::json& object) {
  if (!object.is_object()) return;
  std::vector<Value> values;
  std::vector<std::uint8_t> bytes;
  for (auto item = object.begin(); item != object.end(); ++item) {
    const auto begins = static_cast<std::uint32_t>(bytes.size());
    nlohmann::json::to_cbor(item.value(), bytes);
    values.push_back({item.key(), begins, static_cast<std::uint32_t>(bytes.size())});
  }
  *this = Summary(std::move(values), bytes);
}

Summary Summary::of_text(std::string_view text) {
  Packing packing;
  if (!nlohmann::json::sax_parse(text, &packing)) return {};
  return std::move(packing).summary();
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
