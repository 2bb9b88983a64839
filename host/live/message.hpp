// message.hpp - what goes to a tab, and how it gets there.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace kreisel::core::live {

/// A text is JSON; what is binary begins with a line of JSON that says what the bytes after it are.
struct Message {
  std::string bytes;
  bool binary = false;
  /// One that was not sent yet gives way to the next of its kind; empty: it waits for its turn.
  std::string kind = {};
};

/// From any thread.
using Send = std::function<void(Message)>;

/// What is not UTF-8 in it is replaced, so that it arrives. Numbers that are not finite are null.
[[nodiscard]] inline std::string text_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

[[nodiscard]] inline Message message(const nlohmann::json& json, std::string kind = {}) {
  return {text_of(json), false, std::move(kind)};
}

[[nodiscard]] inline Message with_bytes(const nlohmann::json& head, std::string_view bytes) {
  std::string all = text_of(head) + "\n";
  all += bytes;
  return {std::move(all), true, {}};
}

}  // namespace kreisel::core::live
