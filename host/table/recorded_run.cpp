#include "table/recorded_run.hpp"

#include <fmt/format.h>

#include "table/experiment_run.hpp"

namespace kreisel::core {

using nlohmann::json;

std::map<std::string, std::string> RecordedRun::fields() const {
  std::map<std::string, std::string> fields;
  if (record) {  // the same, and there without the run, too
    fields = record->config();
    if (const json shapes = at("shapes"); shapes.is_string()) fields["shapes"] = shapes;
  } else {
    fields = fields_of(run);
  }
  fields["label"] = run.label;
  return fields;
}

std::string RecordedRun::field(const std::string& name) const {
  if (name == "label") return run.label;
  if (!record || name == "shapes") {
    const auto all = fields();
    const auto found = all.find(name);
    return found == all.end() ? "" : found->second;
  }
  const json config = record->summary.at("config");
  const auto found = config.find(name);
  return found == config.end() ? "" : found->get<std::string>();
}

std::string RecordedRun::termination() const {
  if (!record) return "not run";
  if (!record->error.empty()) return "error";
  const json said = at("termination");
  return said.is_string() ? said.get<std::string>() : "complete";
}

bool RecordedRun::is_optimal() const { return has_result() && termination() == "optimal"; }

bool RecordedRun::is_converged() const {
  return is_optimal() || (has_result() && termination() == "acceptable");
}

json RecordedRun::at(std::string_view name) const { return record ? record->summary.at(name) : json(); }

std::optional<double> RecordedRun::number(std::string_view name) const {
  const json found = at(name);
  return found.is_number() ? std::optional(found.get<double>()) : std::nullopt;
}

std::string note_of(const RecordedRun& run, bool unless_optimal, std::string name) {
  if (!run.record || run.is_optimal()) return "";
  if (run.has_result() && !unless_optimal) return "";
  const json said = run.at("message");
  const std::string words = !run.has_result()  ? run.record->error
                            : said.is_string() ? said.get<std::string>()
                                               : "";
  if (name.empty()) name = run_text(run.run);
  return fmt::format("! {}: {}{}{}\n", name, run.termination(), words.empty() ? "" : " - ", words);
}

}  // namespace kreisel::core
