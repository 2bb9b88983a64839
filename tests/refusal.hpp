// refusal.hpp - bad input is refused in one clear line.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "error.hpp"

namespace kreisel::core {

/// The call throws InputError with one line that begins with `start` and has "expected" and all the parts.
template <class Call>
void expect_refusal(Call&& call, const std::string& start, const std::vector<std::string>& parts) {
  try {
    call();
    FAIL() << "accepted; expected a refusal with " << (parts.empty() ? start : parts.front());
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find(start), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
    for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  }
}

}  // namespace kreisel::core
