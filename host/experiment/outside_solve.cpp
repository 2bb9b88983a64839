#include "experiment/outside_solve.hpp"

#include <fmt/format.h>

#include <system_error>

#include "error.hpp"
#include "experiment/child.hpp"
#include "memory.hpp"
#include "record/record.hpp"
#include "table/experiment_run.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr double giga = 1e9;
// Of `bench`, docs/output.md.
constexpr int converged_code = 0, infeasible_code = 3, not_converged_code = 4, stopped_code = 130;

std::vector<std::string> words_of(const RunConfig& config, const fs::path& record) {
  std::vector<std::string> words = {program_beside("bench").string(),
                                    "--record",
                                    record.string(),
                                    "--repeat",
                                    fmt::format("{}", config.repeat),
                                    "--budget",
                                    fmt::format("{}", config.budget_seconds)};
  for (const auto& [field, text] : describe(config)) {
    if (field.find('.') == std::string::npos)
      words.push_back(fmt::format("--{}={}", field, text));
    else
      words.insert(words.end(), {"--set", fmt::format("{}={}", field, text)});
  }
  return words;
}

/// "bench: what": the program's name is no part of why a run failed.
std::string without_name(const std::string& line) {
  constexpr std::string_view name = "bench: ";
  return line.starts_with(name) ? line.substr(name.size()) : line;
}

}  // namespace

OutsideSolve::OutsideSolve(const PlannedRun& run)
    : run_(run), partial_(fs::path(run.record).replace_extension(".new.h5")) {}

OutsideSolve::~OutsideSolve() {
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

void OutsideSolve::run(const Control& control) {
  const Limits& limits = run_.run.solve().limits;
  control.tell("in a process of its own");
  const ChildEnd end = run_child(words_of(run_.run.solve(), partial_), limits, true);
  if (!end.limit.empty()) throw InputError(end.limit);
  whole_ = end.code != stopped_code;
  if (!whole_) return;
  std::error_code ignored;
  const bool recorded = fs::exists(partial_, ignored);
  // `bench` ends so when it asks for memory and there is none, however little it has used by then.
  const bool refused_memory = end.code == not_converged_code && !recorded;
  if (refused_memory && limits.gigabytes > 0 && available_memory().bytes > giga * limits.gigabytes)
    throw InputError(memory_limit_text(limits));
  const bool ended =
      end.code == converged_code || end.code == infeasible_code || end.code == not_converged_code;
  if (!ended || !recorded)
    throw InputError(end.last_words.empty() ? fmt::format("bench ended with code {}", end.code)
                                            : without_name(end.last_words));
  converged_ = end.code == converged_code;
}

std::string OutsideSolve::text() const {
  const RunResult r = read_run(run_.record);
  return fmt::format("{}: {}, {} variables, {} iterations, {:.3g} s, f = {:.6g}", run_text(run_.run),
                     to_string(r.outcome.termination), r.variables, r.outcome.iterations, r.median.solve,
                     r.outcome.objective);
}

void OutsideSolve::keep() {
  std::error_code error;
  fs::rename(partial_, run_.record, error);
  if (error)
    throw InputError(
        fmt::format("{}: {}, expected to keep the record there", run_.record.string(), error.message()));
}

}  // namespace kreisel::core
