// corpus.hpp - the files that the fuzzers start from, and what they have found.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace kreisel::core::fuzz {

/// Where the files of that reader lie ("off", "experiment").
[[nodiscard]] std::filesystem::path corpus_of(const std::string& reader);

/// Expects that each of a reader's files, given to `feed`, is read or refused in no time.
void expect_fed(const std::string& reader, const std::function<void(const std::string& bytes)>& feed);

}  // namespace kreisel::core::fuzz
