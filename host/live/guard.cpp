#include "live/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

namespace kreisel::core::live {
namespace {

/// In a time that tells nothing of where they differ.
bool equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differ = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differ |= static_cast<unsigned>(a[i] ^ b[i]);
  return differ == 0;
}

}  // namespace

std::string random_token() {
  std::random_device device;  // of the system, not of a seed
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

std::string Guard::url() const { return fmt::format("http://127.0.0.1:{}/{}/", port_, token_); }

bool Guard::is_here(std::string_view host) const {
  constexpr std::array<std::string_view, 2> names = {"127.0.0.1", "localhost"};
  return std::ranges::any_of(names, [&](std::string_view name) {
    return host == fmt::format("{}:{}", name, port_) || (port_ == 80 && host == name);
  });
}

std::optional<std::string_view> Guard::path_of(const Asking& asking) const {
  constexpr std::string_view scheme = "http://";
  if (!is_here(asking.host)) return {};
  if (asking.origin && !(asking.origin->starts_with(scheme) && is_here(asking.origin->substr(scheme.size()))))
    return {};
  std::string_view path = asking.target.substr(0, asking.target.find('?'));
  if (!path.starts_with('/')) return {};
  path.remove_prefix(1);
  const std::size_t end = path.find('/');
  if (end == std::string_view::npos || !equal(path.substr(0, end), token_)) return {};
  return path.substr(end + 1);
}

}  // namespace kreisel::core::live
