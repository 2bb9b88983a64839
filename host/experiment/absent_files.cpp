#include "experiment/absent_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "body/source.hpp"

namespace kreisel::core {

std::vector<std::string> models_of(const ExperimentRun& run) {
  if (!run.nest) return {run.config.body.model};
  std::vector<std::string> models = {run.nest->outer};
  const auto add = [&](const std::string& model) {
    if (!model.empty() && std::ranges::find(models, model) == models.end()) models.push_back(model);
  };
  add(run.nest->inner);
  for (const std::string& model : run.nest->within) add(model);
  return models;
}

std::string text_of_absent(const ExperimentRun& run) {
  std::vector<std::string> absent = models_of(run);
  std::erase_if(absent, [](const std::string& model) { return !is_absent_file(model); });
  if (absent.empty()) return {};
  return fmt::format("no {} in the current folder nor in {}; --models names another",
                     fmt::join(absent, ", no "), models_folder().string());
}

}  // namespace kreisel::core
