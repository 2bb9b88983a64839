// zip_file.hpp - a ZIP archive without compression, written by hand: what a 3MF reader is to read.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace kreisel::core {

inline std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// The archive of the files (name, content).
inline std::string zip_file(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  const auto put = [](std::string& to, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) to += static_cast<char>(value >> (8 * i) & 0xff);
  };
  for (const auto& [name, content] : files) {
    std::string common;          // of local and central header
    put(common, 10, 2);          // version needed
    put(common, 0, 2);           // flags
    put(common, 0, 2);           // stored
    put(common, 0x00210000, 4);  // 1980-01-01
    put(common, crc32(content), 4);
    put(common, std::uint32_t(content.size()), 4);
    put(common, std::uint32_t(content.size()), 4);
    put(common, std::uint32_t(name.size()), 2);
    put(common, 0, 2);  // no extra field
    put(directory, 0x02014b50, 4);
    put(directory, 10, 2);  // made by
    directory += common;
    put(directory, 0, 2);  // no comment
    put(directory, 0, 2);  // first disk
    put(directory, 0, 2);  // attributes
    put(directory, 0, 4);
    put(directory, std::uint32_t(archive.size()), 4);
    directory += name;
    put(archive, 0x04034b50, 4);
    archive += common + name + content;
  }
  const auto start = std::uint32_t(archive.size());
  archive += directory;
  put(archive, 0x06054b50, 4);
  put(archive, 0, 4);  // this disk, disk of the directory
  put(archive, std::uint32_t(files.size()), 2);
  put(archive, std::uint32_t(files.size()), 2);
  put(archive, std::uint32_t(directory.size()), 4);
  put(archive, start, 4);
  put(archive, 0, 2);
  return archive;
}

}  // namespace kreisel::core
