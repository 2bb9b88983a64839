// hdf5_file.hpp - the little of HDF5 that records need: groups, attributes, one- and two-dimensional tables.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kreisel::core::hdf5 {

/// An identifier of the library (its hid_t), closed with the object. The header of HDF5 stays out of ours.
class Handle {
 public:
  using Close = int (*)(std::int64_t);
  Handle(std::int64_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] std::int64_t id() const { return id_; }
  /// Closes now. @return  whether the library agreed; for a file this is when the last bytes are written
  [[nodiscard]] bool close();

 private:
  std::int64_t id_;
  Close close_;
};

/// Shape of a table, row-major. columns = 0: one-dimensional.
struct Shape {
  std::size_t rows = 0, columns = 0;
  [[nodiscard]] std::size_t count() const { return columns == 0 ? rows : rows * columns; }
  bool operator==(const Shape&) const = default;
};

/// What a dataset's attributes say of it.
struct Labels {
  std::string units;  ///< of the values; "1" for plain numbers
  std::vector<std::string>
      columns;  ///< names of the columns, or of the entries of a short vector; may be empty
};

template <class T>
struct Table {
  Shape shape;
  std::vector<T> values;  ///< shape.count() values, row-major
};

/// A group of an open file. Every member throws InputError with the file's name, the object's name and HDF5's
/// own words when the library refuses.
class Group {
 public:
  /// Strings are UTF-8 of variable length: h5py reads them as str. A bool is one unsigned byte, 0 or 1.
  template <class T>
  void set(const std::string& name, const T& value) {
    if constexpr (std::convertible_to<const T&, std::string_view>)
      set_text(name, value);
    else if constexpr (std::same_as<T, bool>)
      set_bool(name, value);
    else if constexpr (std::integral<T>)
      set_integer(name, static_cast<std::int64_t>(value));
    else
      set_real(name, double{value});
  }

  /// Datasets above a few hundred values are stored compressed (gzip). @param values  shape.count() of them
  void write(const std::string& name, std::span<const double> values, Shape shape, const Labels& labels);
  void write(const std::string& name, std::span<const int> values, Shape shape, const Labels& labels);

  /// Makes a new group inside this one.
  [[nodiscard]] Group new_group(const std::string& name);
  [[nodiscard]] Group group(const std::string& name) const;

  [[nodiscard]] bool has(const std::string& attribute) const;
  /// Whether there is a dataset or group of that name.
  [[nodiscard]] bool contains(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> attributes() const;
  /// Names of the datasets and groups in it, sorted.
  [[nodiscard]] std::vector<std::string> children() const;
  [[nodiscard]] std::string text(const std::string& attribute) const;
  [[nodiscard]] std::int64_t integer(const std::string& attribute) const;
  [[nodiscard]] double real(const std::string& attribute) const;
  [[nodiscard]] Table<double> read(const std::string& dataset) const;
  [[nodiscard]] Table<int> read_integers(const std::string& dataset) const;

 protected:
  Group(Handle handle, std::shared_ptr<const std::string> file)
      : handle_(std::move(handle)), file_(std::move(file)) {}
  [[noreturn]] void fail(const std::string& name, std::string_view what) const;

  Handle handle_;
  std::shared_ptr<const std::string> file_;  ///< its name, for messages

 private:
  void set_text(const std::string& name, std::string_view value);
  void set_bool(const std::string& name, bool value);
  void set_integer(const std::string& name, std::int64_t value);
  void set_real(const std::string& name, double value);
  [[nodiscard]] Handle check(std::int64_t id, Handle::Close closer, const std::string& name,
                             std::string_view what) const;
  template <class T>
  void write_table(const std::string& name, std::span<const T> values, Shape shape, const Labels& labels);
  template <class T>
  Table<T> read_table(const std::string& name) const;
};

/// An open file; as a group, its root. Opening the first one turns HDF5's own printing of errors off.
class File : public Group {
 public:
  /// A new, empty file, kept in memory until close().
  [[nodiscard]] static File create(const std::filesystem::path& path);
  /// An existing file, read-only.
  [[nodiscard]] static File open(const std::filesystem::path& path);

  /// Writes a file that create() gave; it appears whole or not at all. Without this call there is none.
  /// @throws InputError  the folder cannot be written, the disk is full
  void close();

 private:
  using Group::Group;
};

}  // namespace kreisel::core::hdf5
