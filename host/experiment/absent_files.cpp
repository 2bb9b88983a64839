#include "experiment/absent_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "body/source.hpp"

namespace kreisel::core {

std::string text_of_absent(const ExperimentRun& run) {
  std::vector<std::string> absent = shapes_of(run.run);
  std::erase_if(absent, [](const std::string& model) { return !is_absent_file(model); });
  if (absent.empty()) return {};
  return fmt::format("no {} in the current folder nor in {}; --models names another",
                     fmt::join(absent, ", no "), models_folder().string());
}

}  // namespace kreisel::core
