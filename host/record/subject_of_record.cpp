#include <fmt/format.h>

#include <cmath>

#include "error.hpp"
#include "problem/problem.hpp"
#include "record/record.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {

Subject subject_of_record(const std::filesystem::path& path, device::Device& device) {
  const RecordSummary record = read_record(path);
  if (!record.error.empty() || record.termination == "infeasible")
    throw InputError(fmt::format("{}: a run without a part ({}); expected the record of one that ended well",
                                 path.string(), record.error.empty() ? record.termination : record.error));
  Subject subject;
  for (const auto& [key, value] : record.config)
    if (key != "device") set_field(subject.config, key, value);
  if (find_problem(record.problem).upright) {  // these ask for its surface, too
    BodySpec spec = subject.config.body;
    spec.stands_upright = true;
    subject.solid = make_body(spec, device);
  } else {
    subject.solid.name = record.model;
    subject.solid.frame.length = record.length_mm;
    subject.solid.density = record.mass_unit_grams / std::pow(record.length_mm, 3) * 1e3;
    subject.solid.solid = record.solid;
  }
  subject.part = record.written;
  return subject;
}

}  // namespace kreisel::core
