#include "record/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "error.hpp"
#include "file/write_text.hpp"

namespace kreisel::core::hdf5 {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>, "Handle keeps identifiers of HDF5 1.10 and later");

// Large enough to hold the tables of any small run in one piece, small enough to read a part of a large one.
constexpr hsize_t chunk_values = 1 << 16;
constexpr std::size_t least_compressed = 256;  // below, a chunk's bookkeeping outweighs what gzip saves
constexpr unsigned gzip_level = 4;

/// The words of the innermost error on HDF5's stack: the cause, not the chain of calls above it.
std::string last_words() {
  std::string words = "no reason given";
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_DOWNWARD,
      [](unsigned, const H5E_error2_t* entry, void* data) -> herr_t {
        if (entry->desc != nullptr && *entry->desc != '\0') *static_cast<std::string*>(data) = entry->desc;
        return 0;
      },
      &words);
  std::ranges::replace(words, '\n', ' ');  // some carry the time as ctime() gives it
  return words;
}

[[noreturn]] void fail_in(const std::string& file, const std::string& name, std::string_view what) {
  throw InputError(fmt::format("{}: {}{}{} ({})", file, what, name.empty() ? "" : " ", name, last_words()));
}

template <class T>
hid_t native() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  else
    return H5T_NATIVE_INT;
}

/// A file's type does not depend on the machine that wrote it.
template <class T>
hid_t stored() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_IEEE_F64LE;
  else
    return H5T_STD_I32LE;
}

Handle string_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Handle creation_of(Shape shape) {
  Handle plist(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(plist.id(), false);  // equal results, equal bytes
  if (shape.count() >= least_compressed) {
    const hsize_t columns = std::max<hsize_t>(shape.columns, 1);
    const std::array<hsize_t, 2> chunk = {
        std::min<hsize_t>(shape.rows, std::max<hsize_t>(chunk_values / columns, 1)), columns};
    H5Pset_chunk(plist.id(), shape.columns == 0 ? 1 : 2, chunk.data());
    H5Pset_shuffle(plist.id());
    H5Pset_deflate(plist.id(), gzip_level);
  }
  return plist;
}

}  // namespace

bool Handle::close() {
  const std::int64_t id = id_;
  id_ = -1;
  return id < 0 || close_(id) >= 0;
}

void Group::fail(const std::string& name, std::string_view what) const { fail_in(*file_, name, what); }

Handle Group::check(std::int64_t id, Handle::Close closer, const std::string& name,
                    std::string_view what) const {
  if (id < 0) fail(name, what);
  return {id, closer};
}

namespace {

/// One scalar attribute, written or not.
bool put(hid_t where, const std::string& name, hid_t file_type, hid_t memory_type, const void* value,
         hid_t space_id) {
  const Handle attribute(H5Acreate2(where, name.c_str(), file_type, space_id, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return attribute.id() >= 0 && H5Awrite(attribute.id(), memory_type, value) >= 0;
}

bool put_scalar(hid_t where, const std::string& name, hid_t file_type, hid_t memory_type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  return space.id() >= 0 && put(where, name, file_type, memory_type, value, space.id());
}

bool put_text(hid_t where, const std::string& name, const std::string& value) {
  const Handle type = string_type();
  const char* pointer = value.c_str();
  return put_scalar(where, name, type.id(), type.id(), &pointer);
}

bool put_texts(hid_t where, const std::string& name, const std::vector<std::string>& values) {
  const Handle type = string_type();
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  const hsize_t count = pointers.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  return space.id() >= 0 && put(where, name, type.id(), type.id(), pointers.data(), space.id());
}

}  // namespace

void Group::set_text(const std::string& name, std::string_view value) {
  if (!put_text(handle_.id(), name, std::string(value))) fail(name, "cannot write attribute");
}

void Group::set_bool(const std::string& name, bool value) {
  const std::uint8_t byte = value ? 1 : 0;
  if (!put_scalar(handle_.id(), name, H5T_STD_U8LE, H5T_NATIVE_UINT8, &byte))
    fail(name, "cannot write attribute");
}

void Group::set_integer(const std::string& name, std::int64_t value) {
  if (!put_scalar(handle_.id(), name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value))
    fail(name, "cannot write attribute");
}

void Group::set_real(const std::string& name, double value) {
  if (!put_scalar(handle_.id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value))
    fail(name, "cannot write attribute");
}

template <class T>
void Group::write_table(const std::string& name, std::span<const T> values, Shape shape,
                        const Labels& labels) {
  if (values.size() != shape.count())
    throw std::logic_error(
        fmt::format("{}: {} has {} values, its shape {}", *file_, name, values.size(), shape.count()));
  const std::array<hsize_t, 2> size = {shape.rows, shape.columns};
  const int rank = shape.columns == 0 ? 1 : 2;
  const Handle space = check(H5Screate_simple(rank, size.data(), nullptr), H5Sclose, name, "cannot shape");
  const Handle plist = creation_of(shape);
  const Handle set = check(
      H5Dcreate2(handle_.id(), name.c_str(), stored<T>(), space.id(), H5P_DEFAULT, plist.id(), H5P_DEFAULT),
      H5Dclose, name, "cannot make dataset");
  if (!values.empty() && H5Dwrite(set.id(), native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(name, "cannot write dataset");
  if (!put_text(set.id(), "units", labels.units) ||
      (!labels.columns.empty() && !put_texts(set.id(), "columns", labels.columns)))
    fail(name, "cannot label dataset");
}

template <class T>
Table<T> Group::read_table(const std::string& name) const {
  const Handle set = check(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, name, "no dataset");
  const Handle space = check(H5Dget_space(set.id()), H5Sclose, name, "no shape of dataset");
  std::array<hsize_t, 2> size{};
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank < 1 || rank > 2) fail(name, "one or two dimensions expected of dataset");
  H5Sget_simple_extent_dims(space.id(), size.data(), nullptr);
  Table<T> table{{size[0], rank == 2 ? size[1] : 0}, {}};
  table.values.resize(table.shape.count());
  if (!table.values.empty() &&
      H5Dread(set.id(), native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, table.values.data()) < 0)
    fail(name, "cannot read dataset");
  return table;
}

void Group::write(const std::string& name, std::span<const double> values, Shape shape,
                  const Labels& labels) {
  write_table(name, values, shape, labels);
}
void Group::write(const std::string& name, std::span<const int> values, Shape shape, const Labels& labels) {
  write_table(name, values, shape, labels);
}
Table<double> Group::read(const std::string& dataset) const { return read_table<double>(dataset); }
Table<int> Group::read_integers(const std::string& dataset) const { return read_table<int>(dataset); }

Group Group::new_group(const std::string& name) {
  return {check(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name,
                "cannot make group"),
          file_};
}

Group Group::group(const std::string& name) const {
  return {check(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose, name, "no group"), file_};
}

bool Group::has(const std::string& attribute) const { return H5Aexists(handle_.id(), attribute.c_str()) > 0; }

bool Group::contains(const std::string& name) const {
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Group::attributes() const {
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  if (H5Aiterate2(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names) < 0)
    fail("", "cannot list attributes");
  return names;
}

std::vector<std::string> Group::children() const {
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  if (H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names) < 0)
    fail("", "cannot list what is in it");
  return names;
}

std::string Group::text(const std::string& name) const {
  const Handle attribute =
      check(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose, name, "no attribute");
  const Handle kept = check(H5Aget_type(attribute.id()), H5Tclose, name, "no type of attribute");
  const Handle space = check(H5Aget_space(attribute.id()), H5Sclose, name, "no shape of attribute");
  if (H5Tis_variable_str(kept.id()) <= 0 || H5Sget_simple_extent_npoints(space.id()) != 1)
    fail(name, "one string of variable length expected of attribute");
  char* found = nullptr;  // read with the type kept: HDF5 converts between no character sets
  if (H5Aread(attribute.id(), kept.id(), &found) < 0) fail(name, "cannot read attribute");
  std::string value = found != nullptr ? found : "";
  H5free_memory(found);
  return value;
}

namespace {

bool get(hid_t where, const std::string& name, hid_t type, void* value) {
  const Handle attribute(H5Aopen(where, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (attribute.id() < 0) return false;
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  return H5Sget_simple_extent_npoints(space.id()) == 1 && H5Aread(attribute.id(), type, value) >= 0;
}

}  // namespace

std::int64_t Group::integer(const std::string& name) const {
  std::int64_t value = 0;
  if (!get(handle_.id(), name, H5T_NATIVE_INT64, &value)) fail(name, "no whole number in attribute");
  return value;
}

double Group::real(const std::string& name) const {
  double value = 0;
  if (!get(handle_.id(), name, H5T_NATIVE_DOUBLE, &value)) fail(name, "no number in attribute");
  return value;
}

namespace {

/// What failed is in the exception; the library's own report on stderr would only repeat it.
void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// Closing a file refuses while a group of it is open, instead of putting the last write off unseen.
Handle access() {
  Handle plist(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(plist.id(), H5F_CLOSE_SEMI);
  return plist;
}

}  // namespace

File File::create(const std::filesystem::path& path) {
  be_quiet();
  const Handle how = access();
  constexpr std::size_t growth = 1 << 20;
  // In memory: the library does not survive a full disk, it crashes while the program ends. By a name that is
  // not there: it opens what has the name all the same, and a pipe's reader would then see its end.
  const std::string in_memory = path.string() + ".in-memory";
  Handle file(H5Pset_fapl_core(how.id(), growth, false) < 0
                  ? -1
                  : H5Fcreate(in_memory.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, how.id()),
              H5Fclose);
  if (file.id() < 0) fail_in(path.string(), "", "cannot be made in memory");
  return {std::move(file), std::make_shared<const std::string>(path.string())};
}

File File::open(const std::filesystem::path& path) {
  be_quiet();
  const Handle how = access();
  // In one read: the library takes a record in by fifty small ones.
  constexpr std::uintmax_t small = 1 << 18;
  std::error_code unknown;
  if (const std::uintmax_t size = std::filesystem::file_size(path, unknown); !unknown && size <= small)
    H5Pset_fapl_core(how.id(), 1 << 16, false);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, how.id()), H5Fclose);
  if (file.id() < 0) fail_in(path.string(), "", "cannot be opened, expected an HDF5 file");
  return {std::move(file), std::make_shared<const std::string>(path.string())};
}

void File::close() {
  std::string image;
  if (H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL) < 0) fail("", "cannot be completed");
  if (const ssize_t size = H5Fget_file_image(handle_.id(), nullptr, 0); size > 0)
    image.resize(static_cast<std::size_t>(size));
  if (H5Fget_file_image(handle_.id(), image.data(), image.size()) < 0) fail("", "cannot be completed");
  if (!handle_.close()) fail("", "cannot be closed, a group of it is open");
  write_text(*file_, image);
}

}  // namespace kreisel::core::hdf5
