// to_json.hpp - a result's description, gone over to make JSON.
#pragma once

#include <string_view>
#include <vector>

#include "record/values.hpp"

namespace kreisel::core::fields {

/// The place of "verified.materials.0.name": a word of digits counts in a list.
[[nodiscard]] nlohmann::json& place(nlohmann::json& root, std::string_view path);

/// NaN and infinity become null, bytes that are no UTF-8 the replacement character: what dump() writes, read
/// back, so that whoever dumps the answer need not think of either.
[[nodiscard]] nlohmann::json plain(nlohmann::json value);

/// Fields have a place in the file and one in JSON; "" where they are not there.
class ToJson {
 public:
  static constexpr bool reading = false;

  template <class T>
  void value(std::string_view, std::string_view json, const T& v, const char* = "") {
    if (!json.empty()) place(root_, json) = json_of(v);
  }
  template <class T>
  void late(std::string_view file, std::string_view json, const T& v, const char* units = "") {
    value(file, json, v, units);
  }
  template <class T>
  void scaled(std::string_view file, std::string_view json, const T& v, double factor) {
    value(file, json, (v * factor));
  }
  /// Names that the writer chose: where one of ours is of the same name, ours wins by coming later.
  template <class Map>
  void names(std::string_view, std::string_view, std::string_view json, const Map& map) {
    nlohmann::json& at = json.empty() ? root_ : place(root_, json);
    if (at.is_null()) at = nlohmann::json::object();
    for (const auto& [name, v] : map) at[name] = v;
  }
  template <class V>
  void given(std::string_view json, V&& v) {
    place(root_, json) = nlohmann::json(std::forward<V>(v));
  }
  template <class V>
  void stored(std::string_view, const V&) {}
  template <class F>
  void bulk(std::string_view, F&&) {}
  template <class F>
  void load(std::string_view, F&&) {}
  template <class N>
  void count(std::string_view, std::string_view json, const N& n) {
    place(root_, json) = n;
  }
  bool part(std::string_view, std::string_view json, bool present) {
    if (!present && !json.empty()) place(root_, json) = nullptr;
    return present;
  }

  template <class Row, class Columns>
  void rows(std::string_view, std::string_view json, const std::vector<Row>& all, const char*,
            const Columns& columns) {
    if (json.empty()) return;
    nlohmann::json& list = place(root_, json);
    if (list.is_null()) list = nlohmann::json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (list.size() <= i) list.push_back(nlohmann::json::object());
      Row row = all[i];
      ObjectColumns object{list[i]};
      columns(object, row);
    }
  }
  template <class Row, class Columns>
  void row(std::string_view file, std::string_view json, const Row& one, const char* units,
           const Columns& columns) {
    if (json.empty()) return;
    nlohmann::json list;
    ToJson inner;
    inner.rows(file, "list", std::vector<Row>{one}, units, columns);
    place(root_, json) = inner.root_["list"][0];
  }
  template <class Row, class Columns>
  void flat(std::string_view file, std::string_view json, const Row& one, const char* units,
            const Columns& columns) {
    row(file, json, one, units, columns);
  }
  template <class Items, class Key, class Each>
  void each(std::string_view, Items& items, Key, const Each& visit) {
    std::size_t index = 0;
    for (auto& item : items) visit(item, index++);
  }

  [[nodiscard]] nlohmann::json json() && { return plain(std::move(root_)); }

 private:
  struct ObjectColumns {
    static constexpr bool reading = false;
    nlohmann::json& object;
    template <class T>
    void operator()(std::string_view name, const T& v, std::string_view json = {}) {
      place(object, json.empty() ? name : json) = json_of(v);
    }
    template <class M>
    void matrix(const std::vector<std::string>&, const M& m, std::string_view json) {
      if (!json.empty()) place(object, json) = json_of(m);
    }
    template <class T>
    void hidden(std::string_view, const T&) {}
    template <class V>
    void given(std::string_view json, V&& v) {
      place(object, json) = nlohmann::json(std::forward<V>(v));
    }
  };

  nlohmann::json root_ = nlohmann::json::object();
};

}  // namespace kreisel::core::fields
