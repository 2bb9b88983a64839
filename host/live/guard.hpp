// guard.hpp - who may ask: somebody on this machine who was told the token, in a page of ours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kreisel::core::live {

/// 32 hexadecimal digits from the system's random numbers.
[[nodiscard]] std::string random_token();

/// What a request says of where it goes and where it comes from.
struct Asking {
  std::string_view target;                 ///< "/TOKEN/path?query"
  std::string_view host;                   ///< Host
  std::optional<std::string_view> origin;  ///< Origin, where there is one
};

class Guard {
 public:
  Guard(std::uint16_t port, std::string token) : port_(port), token_(std::move(token)) {}

  [[nodiscard]] std::string url() const;
  /// The path behind the token, without its slash and query; nothing: it is not to be answered. A name that
  /// was made to lead to this machine is not its own: so no other page reaches the server by one.
  [[nodiscard]] std::optional<std::string_view> path_of(const Asking& asking) const;

 private:
  [[nodiscard]] bool is_here(std::string_view host) const;

  std::uint16_t port_;
  std::string token_;
};

}  // namespace kreisel::core::live
