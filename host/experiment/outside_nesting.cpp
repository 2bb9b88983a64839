#include "experiment/outside_nesting.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "experiment/child.hpp"
#include "experiment/run_text.hpp"
#include "record/nest_record.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr int interrupted_code = 130;  // and of a program that Ctrl-C ends: 128 + SIGINT

std::vector<std::string> words_of(const NestConfig& config, const fs::path& record) {
  std::vector<std::string> words = {program_beside("nest_baseline").string(), "--record", record.string()};
  for (const auto& [field, text] : describe(config)) {
    words.push_back("--" + field);
    // Several words are several arguments.
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t space = std::min(text.find(' ', at), text.size());
      words.push_back(text.substr(at, space - at));
      at = space + 1;
    }
  }
  if (!config.device.empty()) words.insert(words.end(), {"--device", config.device});
  return words;
}

}  // namespace

void OutsideNesting::run(const Control& control) {
  control.tell("by nest_baseline");
  const int code = run_child(words_of(*run_.run.nest, run_.record)).code;
  whole_ = code != interrupted_code;
  if (whole_ && code != 0)
    throw InputError(fmt::format("nest_baseline ended with code {}, and said why", code));
}

std::string OutsideNesting::text() const {
  const NestResult nest = read_nest(run_.record);
  return fmt::format("{}: {}, scale {:.4f}, {} evaluations, {:.3g} s", run_text(run_.run),
                     termination_of(nest), nest.scale, nest.evaluations, nest.search_seconds);
}

}  // namespace kreisel::core
