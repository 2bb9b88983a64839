#include "file/content_key.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace kreisel::core {
namespace {

std::uint64_t fnv1a(std::string_view text, std::uint64_t basis) {
  for (const char c : text) basis = (basis ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return basis;
}

}  // namespace

std::string content_key(std::string_view content) {
  return fmt::format("{:016x}{:016x}", fnv1a(content, 0xcbf29ce484222325ull),
                     fnv1a(content, 0x6c62272e07bb0142ull));
}

}  // namespace kreisel::core
