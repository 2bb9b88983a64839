#include "table/experiment_run.hpp"

namespace kreisel::core {

std::map<std::string, std::string> fields_of(const ExperimentRun& run) {
  auto fields = describe(run.run);
  if (const auto* nest = std::get_if<NestConfig>(&*run.run)) fields["shapes"] = shapes_text(*nest);
  return fields;
}

Limits limits_of(const ExperimentRun& run) {
  const auto* solve = std::get_if<RunConfig>(&*run.run);
  return solve ? solve->limits : Limits();
}

const Asked& ExperimentRun::asked() const {
  const Asked* asked = asked_of(*run);
  if (!asked) throw std::bad_variant_access();
  return *asked;
}
Asked& ExperimentRun::asked() {
  Asked* asked = asked_of(run.changed());
  if (!asked) throw std::bad_variant_access();
  return *asked;
}

std::string run_text(const ExperimentRun& run) {
  const bool nesting = std::holds_alternative<NestConfig>(*run.run);
  return run_text(run.run) + (nesting && !run.label.empty() ? " " + run.label : "");
}

}  // namespace kreisel::core
