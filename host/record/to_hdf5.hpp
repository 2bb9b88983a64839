// to_hdf5.hpp - a result's description, gone over to write a file.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "record/values.hpp"

namespace kreisel::core::fields {

/// Columns of a row, for writing: their names, and the values of row after row.
struct WrittenColumns {
  static constexpr bool reading = false;
  std::vector<std::string> names;
  std::vector<double> values;

  template <class T>
  void operator()(std::string_view name, const T& v, std::string_view = {}) {
    names.emplace_back(name);
    if constexpr (std::same_as<T, std::optional<double>>)
      values.push_back(v.value_or(std::numeric_limits<double>::quiet_NaN()));
    else
      values.push_back(static_cast<double>(v));
  }
  template <class M>
  void matrix(const std::vector<std::string>& columns, const M& m, std::string_view = {}) {
    names.insert(names.end(), columns.begin(), columns.end());
    const std::vector<double> all = numbers_of(m);
    values.insert(values.end(), all.begin(), all.end());
  }
  /// A column of the file that JSON does not have.
  template <class T>
  void hidden(std::string_view name, const T& v) {
    (*this)(name, v);
  }
  template <class V>
  void given(std::string_view, V&&) {}
};

class ToHdf5 {
 public:
  static constexpr bool reading = false;
  explicit ToHdf5(hdf5::Group& root) : root_(root) {}

  template <class T>
  void value(std::string_view file, std::string_view, const T& v, const char* units = "") {
    if (file.empty()) return;
    const auto [group, name] = at(file);
    if constexpr (Named<T>) {
      group->set(name, to_string(v));
    } else if constexpr (Matrix<T>) {
      write_matrix(*group, name, numbers_of(v), v.rows(), v.cols(), units);
    } else if constexpr (std::same_as<T, std::filesystem::path>) {
      group->set(name, v.string());
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      group->set(name, v.value_or(std::numeric_limits<double>::quiet_NaN()));
    } else if constexpr (std::same_as<T, std::array<int, 3>>) {
      group->write(name, v, {3}, {units, {"x", "y", "z"}});
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      group->write(name, v, {v.size()}, {units, {}});
    } else if constexpr (std::same_as<T, std::vector<std::string>>) {
      std::string lines;
      for (const std::string& line : v) lines += (&line == v.data() ? "" : "\n") + line;
      group->set(name, lines);
    } else {
      group->set(name, v);
      if (*units) group->set(name + "_units", std::string_view(units));
    }
  }
  template <class T>
  void late(std::string_view file, std::string_view json, const T& v, const char* units = "") {
    value(file, json, v, units);
  }
  template <class T>
  void scaled(std::string_view file, std::string_view json, const T& v, double factor) {
    value(file, json, (v * factor));
  }
  template <class Map>
  void names(std::string_view group, std::string_view prefix, std::string_view, const Map& map) {
    hdf5::Group& into = at_group(group);
    for (const auto& [name, v] : map) into.set(std::string(prefix) + name, v);
  }
  template <class V>
  void given(std::string_view, V&&) {}
  template <class V>
  void stored(std::string_view file, const V& v) {
    value(file, "", v);
  }
  template <class F>
  void bulk(std::string_view group, F&& write) {
    write(at_group(group));
  }
  template <class F>
  void load(std::string_view, F&&) {}
  template <class N>
  void count(std::string_view, std::string_view, const N&) {}
  bool part(std::string_view, std::string_view, bool present) { return present; }

  template <class Row, class Columns>
  void rows(std::string_view file, std::string_view, const std::vector<Row>& all, const char* units,
            const Columns& columns) {
    WrittenColumns names, values;
    static Row none{};  // its columns alone are asked; static, so that vectors, too, begin as zero
    columns(names, none);
    for (Row row : all) columns(values, row);
    const auto [group, name] = at(file);
    group->write(name, values.values, {values.values.size() / names.names.size(), names.names.size()},
                 {units, names.names});
  }
  template <class Row, class Columns>
  void row(std::string_view file, std::string_view json, const Row& one, const char* units,
           const Columns& columns) {
    rows(file, json, std::vector<Row>{one}, units, columns);
  }
  /// The same of one dimension.
  template <class Row, class Columns>
  void flat(std::string_view file, std::string_view, Row one, const char* units, const Columns& columns) {
    WrittenColumns written;
    columns(written, one);
    const auto [group, name] = at(file);
    group->write(name, written.values, {written.values.size()}, {units, written.names});
  }
  template <class Items, class Key, class Each>
  void each(std::string_view path, Items& items, Key key, const Each& visit) {
    std::vector<std::string> order;  // HDF5 sorts by name
    for (const auto& item : items) order.push_back(item.*key);
    if (!order.empty()) value(std::string(path) + "/order", "", order);
    std::size_t index = 0;
    for (auto& item : items) visit(item, index++);
  }

 private:
  /// The group of "solve/message", made where it is not there yet, and "message".
  std::pair<hdf5::Group*, std::string> at(std::string_view file);
  hdf5::Group& at_group(std::string_view path);
  static void write_matrix(hdf5::Group& group, const std::string& name, const std::vector<double>& values,
                           Eigen::Index rows, Eigen::Index columns, const char* units);

  hdf5::Group& root_;
  std::map<std::string, hdf5::Group, std::less<>> groups_;
};

}  // namespace kreisel::core::fields
