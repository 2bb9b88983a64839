#include "experiment/outside_nesting.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "experiment/child.hpp"
#include "record/nest_record.hpp"
#include "table/experiment_run.hpp"
#include "words.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr int interrupted_code = 130;  // and of a program that Ctrl-C ends: 128 + SIGINT

std::vector<std::string> words_of(const NestConfig& config, const fs::path& record) {
  std::vector<std::string> words = {program_beside("nest_baseline").string(), "--record", record.string()};
  for (const auto& [name, text] : describe(config)) {
    if (find_field(entry_of(config).fields, name)->words == 1) {
      words.push_back(fmt::format("--{}={}", name, text));  // whatever it begins with
      continue;
    }
    words.push_back("--" + name);
    for (std::string& word : split_words(text)) words.push_back(std::move(word));
  }
  if (!config.device.empty()) words.insert(words.end(), {"--device", config.device});
  return words;
}

}  // namespace

void OutsideNesting::run(const Control& control) {
  control.tell("by nest_baseline");
  const int code = run_child(words_of(run_.run.nesting(), run_.record)).code;
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
