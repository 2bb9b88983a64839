// first_equal.hpp - which of many things are equal to an earlier one.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stop.hpp"

namespace kreisel::core {

/// Numbers of things by what they are: a hash table without pointers, for as many as a mesh has. It keeps
/// four bytes for each place; what the numbers stand for is the caller's.
class EqualTable {
 public:
  /// @param expected  how many different things there may be; more are taken, too
  explicit EqualTable(std::size_t expected = 0) : places_(std::bit_ceil(2 * expected + 16), none) {}

  /// The number of the thing that is equal to `number`'s: an earlier one, or itself, which is then kept.
  /// @param hash  of a number  @param equal  of two numbers
  template <class Hash, class Equal>
  std::uint32_t operator()(std::uint32_t number, const Hash& hash, const Equal& equal) {
    if (2 * kept_ >= places_.size()) grow(hash);
    for (std::size_t at = place(hash(number));; at = (at + 1) & (places_.size() - 1)) {
      if (places_[at] == none) {
        places_[at] = number;
        ++kept_;
        return number;
      }
      if (equal(places_[at], number)) return places_[at];
    }
  }

  /// Fetches the place where a search for this hash begins: a large table lies in no cache.
  void fetch(std::uint64_t hash) const { __builtin_prefetch(&places_[place(hash)]); }
  /// The number that a search for this hash meets first; `none` where it meets nothing.
  [[nodiscard]] std::uint32_t first_met(std::uint64_t hash) const { return places_[place(hash)]; }
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

 private:
  /// By the upper bits of a product, which every bit of the hash changes.
  [[nodiscard]] std::size_t place(std::uint64_t hash) const {
    return (hash * 0x9e3779b97f4a7c15ULL) >> (64 - std::countr_zero(places_.size()));
  }
  template <class Hash>
  void grow(const Hash& hash) {
    std::vector<std::uint32_t> old(2 * places_.size(), none);
    old.swap(places_);
    for (const std::uint32_t number : old) {
      if (number == none) continue;
      std::size_t at = place(hash(number));
      while (places_[at] != none) at = (at + 1) & (places_.size() - 1);
      places_[at] = number;
    }
  }

  std::vector<std::uint32_t> places_;
  std::size_t kept_ = 0;
};

/// For each of the first `count` numbers the lowest that is equal to it. O(count).
template <class Hash, class Equal>
[[nodiscard]] std::vector<std::uint32_t> first_equal(std::size_t count, const Hash& hash,
                                                     const Equal& equal) {
  EqualTable table(count);
  std::vector<std::uint32_t> first(count);
  constexpr std::uint32_t ahead = 16;  // as far as memory takes longer than a search
  for (std::uint32_t i = 0; i < count; ++i) {
    stop_here(i);
    if (i + ahead < count) table.fetch(hash(i + ahead));
    first[i] = table(i, hash, equal);
  }
  return first;
}

}  // namespace kreisel::core
