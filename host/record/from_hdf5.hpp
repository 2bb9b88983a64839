// from_hdf5.hpp - a result's description, gone over to read a file.
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "record/values.hpp"

namespace kreisel::core::fields {

/// Columns of a row, for reading: the values of a row in turn; without any it only counts them.
struct ReadColumns {
  static constexpr bool reading = true;
  const double* values = nullptr;
  std::size_t taken = 0;

  template <class T>
  void operator()(std::string_view, T& v, std::string_view = {}) {
    if (values) take(v, values[taken]);
    ++taken;
  }
  template <class M>
  void matrix(const std::vector<std::string>&, M& m, std::string_view = {}) {
    const auto n = static_cast<std::size_t>(m.size());
    if (values) assign(m, {values + taken, values + taken + n}, "a row");
    taken += n;
  }
  template <class T>
  void hidden(std::string_view name, T& v) {
    (*this)(name, v);
  }
  template <class V>
  void given(std::string_view, V&&) {}

 private:
  template <class T>
  static void take(T& v, double number) {
    v = static_cast<T>(number);
  }
  static void take(std::optional<double>& v, double number) {
    v = std::isnan(number) ? std::nullopt : std::optional(number);
  }
};

/// What grows with the resolution or the solve (bulk) stays in the file.
class FromHdf5 {
 public:
  static constexpr bool reading = true;
  /// @param name  of the file, for messages
  FromHdf5(const hdf5::Group& root, std::string name) : root_(root), name_(std::move(name)) {}

  template <class T>
  void value(std::string_view file, std::string_view, T& v, const char* = "") {
    if (file.empty()) return;
    const auto [group, name] = at(file);
    if constexpr (Named<T>) {
      v = named<T>(group.text(name));
    } else if constexpr (Matrix<T>) {
      assign(v, group.read(name).values, name_ + ": " + std::string(file));
    } else if constexpr (std::same_as<T, std::filesystem::path> || std::same_as<T, std::string>) {
      v = group.text(name);
    } else if constexpr (std::same_as<T, bool>) {
      v = group.integer(name) != 0;
    } else if constexpr (std::integral<T>) {
      v = static_cast<T>(group.integer(name));
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      const double number = group.real(name);
      v = std::isnan(number) ? std::nullopt : std::optional(number);
    } else if constexpr (std::same_as<T, std::array<int, 3>>) {
      const std::vector<int> all = group.read_integers(name).values;
      if (all.size() != 3)
        throw InputError(name_ + ": " + name + " has " + std::to_string(all.size()) + " numbers, expected 3");
      v = {all[0], all[1], all[2]};
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      v = group.read(name).values;
    } else if constexpr (std::same_as<T, std::vector<std::string>>) {
      std::istringstream lines(group.text(name));
      v.clear();
      for (std::string line; std::getline(lines, line);) v.push_back(line);
    } else {
      v = group.real(name);
    }
  }
  /// Early records do not have it.
  template <class T>
  void late(std::string_view file, std::string_view json, T& v, const char* units = "") {
    if (there(file)) value(file, json, v, units);
  }
  template <class T>
  void scaled(std::string_view file, std::string_view json, T& v, double factor) {
    value(file, json, v);
    v /= factor;
  }
  template <class Map>
  void names(std::string_view path, std::string_view prefix, std::string_view, Map& map) {
    if (!path.empty() && !root_.contains(std::string(path))) return;
    const hdf5::Group& group = at_group(path);
    for (const std::string& name : group.attributes()) {
      if (!name.starts_with(prefix)) continue;
      if constexpr (std::same_as<typename Map::mapped_type, double>)
        map[name.substr(prefix.size())] = group.real(name);
      else
        map[name.substr(prefix.size())] = group.text(name);
    }
  }
  template <class V>
  void given(std::string_view, V&&) {}
  template <class V>
  void stored(std::string_view, const V&) {}
  template <class F>
  void bulk(std::string_view, F&&) {}
  /// What is read otherwise than value by value.
  template <class F>
  void load(std::string_view group, F&& read) {
    read(at_group(group));
  }
  /// How many rows a dataset has that is not read.
  template <class N>
  void count(std::string_view file, std::string_view, N& n) {
    const auto [group, name] = at(file);
    n = static_cast<N>(group.read(name).shape.rows);
  }
  bool part(std::string_view file, std::string_view, bool) { return there(file); }

  template <class Row, class Columns>
  void rows(std::string_view file, std::string_view, std::vector<Row>& all, const char*,
            const Columns& columns) {
    if (!there(file)) return;
    const auto [group, name] = at(file);
    const hdf5::Table<double> table = group.read(name);
    Row none{};
    ReadColumns counted;
    columns(counted, none);
    const std::size_t each = counted.taken, found = table.shape.columns ? table.shape.columns : each;
    if (found == 0 || each % found != 0)
      throw InputError(name_ + ": " + std::string(file) + " has " + std::to_string(found) +
                       " columns, expected " + std::to_string(each));
    all.resize(table.values.size() / each);
    for (std::size_t i = 0; i < all.size(); ++i) {
      ReadColumns row{table.values.data() + i * each};
      columns(row, all[i]);
    }
  }
  template <class Row, class Columns>
  void row(std::string_view file, std::string_view json, Row& one, const char* units,
           const Columns& columns) {
    std::vector<Row> all = {one};  // what no column is of stays as it is
    rows(file, json, all, units, columns);
    if (all.size() != 1)
      throw InputError(name_ + ": " + std::string(file) + " has " + std::to_string(all.size()) +
                       " rows, expected 1");
    one = all.front();
  }
  template <class Row, class Columns>
  void flat(std::string_view file, std::string_view json, Row& one, const char* units,
            const Columns& columns) {
    row(file, json, one, units, columns);
  }
  template <class Items, class Key, class Each>
  void each(std::string_view path, Items& items, Key key, const Each& visit) {
    if (!there(path)) return;
    items.clear();
    std::vector<std::string> names = at_group(path).children();
    late(std::string(path) + "/order", "", names);
    for (const std::string& name : names) {
      items.emplace_back();
      items.back().*key = name;
      visit(items.back(), items.size() - 1);
    }
  }

 private:
  [[nodiscard]] std::pair<const hdf5::Group&, std::string> at(std::string_view file);
  [[nodiscard]] const hdf5::Group& at_group(std::string_view path);
  /// An attribute, dataset or group of that path.
  [[nodiscard]] bool there(std::string_view file);

  const hdf5::Group& root_;
  std::string name_;
  std::map<std::string, hdf5::Group, std::less<>> groups_;  ///< opened so far: it takes as long as ten values
};

}  // namespace kreisel::core::fields
