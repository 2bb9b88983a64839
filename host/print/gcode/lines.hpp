// lines.hpp - lines from blocks of a file.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace kreisel::core {

/// Puts lines together that lie in two blocks. Keeps no more than one line.
class Lines {
 public:
  /// @param each  told of every line that ends in this block, without its end; may throw
  /// @return  the length of the line that goes on into the next block
  template <class Each>
  std::size_t feed(std::string_view block, const Each& each) {
    if (!begun_.empty()) {
      const std::size_t end = block.find('\n');
      begun_ += block.substr(0, end);
      if (end == std::string_view::npos) return begun_.size();
      each(std::string_view(begun_));
      begun_.clear();
      block.remove_prefix(end + 1);
    }
    while (!block.empty()) {
      const void* const end = std::memchr(block.data(), '\n', block.size());
      if (!end) break;
      const auto length = static_cast<std::size_t>(static_cast<const char*>(end) - block.data());
      each(block.substr(0, length));
      block.remove_prefix(length + 1);
    }
    begun_ = block;
    return begun_.size();
  }
  /// The last line where no end of a line follows it; empty: one does.
  [[nodiscard]] std::string take_rest() { return std::exchange(begun_, {}); }

 private:
  std::string begun_;
};

}  // namespace kreisel::core
