#include "experiment/run_text.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace kreisel::core {

std::string grid_text(const GridSpec& grid) {
  if (!grid.cells) return fmt::format("{}", grid.resolution);
  const auto& n = *grid.cells;
  return fmt::format("{}x{}x{}", n[0], n[1], n[2]);
}

std::string model_text(const RunConfig& config) {
  return std::filesystem::path(config.body.model).stem().string();
}

std::string run_text(const RunConfig& config) {
  if (config.map)
    return fmt::format("{} {} {} map{}", model_text(config), grid_text(config.grid), config.problem,
                       config.map->through == Through::centre ? " through centre" : "");
  return fmt::format("{} {} {} {}", model_text(config), grid_text(config.grid), config.formulation,
                     solver_of(config));
}

std::string run_text(const ExperimentRun& run) {
  if (!run.nest) return run_text(run.config);
  const NestConfig& nest = *run.nest;
  const std::string shapes = shapes_text(nest), label = run.label.empty() ? "" : " " + run.label;
  if (kind_of(nest) != "swarm") return fmt::format("{} {}{}", shapes, kind_of(nest), label);
  return fmt::format("{} {} {} seed {}{}", shapes, nest.swarm, nest.free, nest.search.swarm.seed, label);
}

}  // namespace kreisel::core
