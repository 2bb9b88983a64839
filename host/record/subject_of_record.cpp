#include <fmt/format.h>

#include <cmath>

#include "error.hpp"
#include "problem/problem.hpp"
#include "record/records_in.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {

Subject subject_of_record(const std::filesystem::path& path, device::Device& device) {
  const Record record = read_record(path);
  const RunResult run = read_run(path);
  if (!record.error.empty() || run.outcome.termination == Termination::infeasible)
    throw InputError(fmt::format("{}: a run without a part ({}); expected the record of one that ended well",
                                 path.string(),
                                 record.error.empty() ? to_string(run.outcome.termination) : record.error));
  Subject subject;
  subject.config = run.config;
  subject.config.device.clear();
  if (find_problem(run.config.problem).upright) {  // these ask for its surface, too
    BodySpec spec = subject.config.body;
    spec.stands_upright = true;
    subject.solid = make_body(spec, device);
  } else {
    subject.solid.name = run.body_name;
    subject.solid.frame.length = run.length_mm;
    subject.solid.density = run.mass_unit_grams / std::pow(run.length_mm, 3) * 1e3;
    subject.solid.solid = run.solid;
  }
  subject.part = run.verified.moments;
  return subject;
}

}  // namespace kreisel::core
