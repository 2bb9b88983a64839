#include "mesh/io/threemf/package.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "error.hpp"
#include "mesh/io/text.hpp"
#include "stop.hpp"

namespace kreisel::core::threemf {
namespace {

/// More than any printer takes: a small archive can hold far more than memory does.
constexpr std::uint64_t most_bytes = std::uint64_t{4} << 30;

using Reader = std::unique_ptr<archive, decltype(&archive_read_free)>;

[[noreturn]] void refuse(const MeshFile& file, std::string_view what) {
  throw InputError(fmt::format("{}: {}, expected a whole ZIP archive, which 3MF is", file.name, what));
}

[[noreturn]] void refuse(const MeshFile& file, archive* reader) {
  const char* why = archive_error_string(reader);
  refuse(file, shown(why ? why : "ZIP archive cannot be read"));
}

bool is_wanted(const std::string& name) {
  constexpr std::array<std::string_view, 3> wanted = {".model", ".rels", ".config"};
  return std::ranges::any_of(wanted, [&](std::string_view end) { return name.ends_with(end); });
}

std::string content(const MeshFile& file, archive* reader, std::uint64_t& left) {
  std::string text;
  std::array<char, 1 << 16> block;
  for (;;) {
    stop_here();
    const la_ssize_t got = archive_read_data(reader, block.data(), block.size());
    if (got < 0) refuse(file, reader);
    if (got == 0) return text;
    if (std::uint64_t(got) > left)
      throw InputError(
          fmt::format("{}: 3MF package of more than {} bytes, expected fewer", file.name, most_bytes));
    left -= std::uint64_t(got);
    text.append(block.data(), std::size_t(got));
  }
}

}  // namespace

std::string part_name(std::string_view name) {
  std::string part = lower_case(name);
  std::ranges::replace(part, '\\', '/');
  return part.substr(std::min(part.find_first_not_of('/'), part.size()));
}

Package unpack(const MeshFile& file) {
  if (!file.bytes.starts_with("PK"))
    throw InputError(fmt::format("{}: no ZIP archive, expected a 3MF package", file.name));
  const Reader reader(archive_read_new(), &archive_read_free);
  archive_read_support_format_zip_seekable(reader.get());  // by its directory: what was deleted is not in it
  if (archive_read_open_memory(reader.get(), file.bytes.data(), file.bytes.size()) != ARCHIVE_OK)
    refuse(file, "ZIP archive without its directory");
  Package package;
  std::uint64_t left = most_bytes;
  archive_entry* entry = nullptr;
  int status = ARCHIVE_OK;
  while ((status = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    const char* name = archive_entry_pathname(entry);
    const std::string part = part_name(name ? name : "");
    if (is_wanted(part)) package[part] = content(file, reader.get(), left);
  }
  if (status != ARCHIVE_EOF) refuse(file, reader.get());
  return package;
}

std::string pack(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string bytes;
  const std::unique_ptr<archive, decltype(&archive_write_free)> writer(archive_write_new(),
                                                                       &archive_write_free);
  const auto require = [&](bool good) {
    if (good) return;
    const char* why = archive_error_string(writer.get());
    throw std::runtime_error(fmt::format("ZIP archive: {}", why ? why : "cannot be written"));
  };
  const auto append = [](archive*, void* to, const void* data, std::size_t size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
    return la_ssize_t(size);
  };
  require(archive_write_set_format_zip(writer.get()) == ARCHIVE_OK &&
          archive_write_set_bytes_in_last_block(writer.get(), 1) == ARCHIVE_OK &&  // no padding
          archive_write_open(writer.get(), &bytes, nullptr, append, nullptr) == ARCHIVE_OK);
  const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(),
                                                                            &archive_entry_free);
  for (const auto& [name, content] : parts) {
    archive_entry_clear(entry.get());
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_size(entry.get(), la_int64_t(content.size()));
    require(archive_write_header(writer.get(), entry.get()) == ARCHIVE_OK);
    constexpr std::size_t block = std::size_t{1} << 20;  // packing takes longer than a second
    for (std::size_t from = 0; from < content.size(); from += block) {
      stop_here();
      const std::size_t size = std::min(block, content.size() - from);
      require(archive_write_data(writer.get(), content.data() + from, size) == la_ssize_t(size));
    }
  }
  require(archive_write_close(writer.get()) == ARCHIVE_OK);
  return bytes;
}

}  // namespace kreisel::core::threemf
