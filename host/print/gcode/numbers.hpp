// numbers.hpp - numbers of G-code: digits and a point, no exponent, for E is an axis.
#pragma once

#include <cstdint>

#include "parse.hpp"

namespace kreisel::core {

/// Reads the number that `at` begins with, and moves `at` behind it; where none does, it stays.
/// Correctly rounded. @return  finite, or NaN where no number begins, or one beyond all doubles
[[nodiscard]] inline double number_at(const char*& at, const char* end) {
  constexpr double powers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                               1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* p = at;
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* const digits_from = p;
  std::uint64_t digits = 0;
  for (; p != end && unsigned(*p - '0') < 10; ++p) digits = 10 * digits + std::uint64_t(*p - '0');
  auto count = p - digits_from;
  std::ptrdiff_t decimals = 0;
  if (p != end && *p == '.') {
    const char* const point = p++;
    for (; p != end && unsigned(*p - '0') < 10; ++p) digits = 10 * digits + std::uint64_t(*p - '0');
    decimals = p - point - 1;
    count += decimals;
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (count == 0) return none;
  const char* const began = at;
  at = p;
  // Up to 2^53 and 10^22 both are doubles, and their quotient is rounded once.
  if (count <= 15) {
    const double value = static_cast<double>(digits) / powers[decimals];
    return negative ? -value : value;
  }
  return parse<double>({began, static_cast<std::size_t>(p - began)}).value_or(none);
}

}  // namespace kreisel::core
