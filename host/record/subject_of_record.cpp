#include <fmt/format.h>

#include "error.hpp"
#include "record/records_in.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {

Subject subject_of_record(const std::filesystem::path& path, device::Device& device) {
  const auto refuse = [&](std::string_view why) {
    return InputError(fmt::format("{}: a run without a part ({}); expected the record of one that ended well",
                                  path.string(), why));
  };
  if (const Record record = read_record(path); !record.error.empty()) throw refuse(record.error);
  RunResult run = read_run(path);
  if (run.outcome.termination == Termination::infeasible) throw refuse(to_string(run.outcome.termination));
  run.config.device.clear();
  return subject_of_numbers(
      run.config, {run.body_name, run.length_mm, run.mass_unit_grams, run.solid, run.verified.moments},
      device);
}

}  // namespace kreisel::core
