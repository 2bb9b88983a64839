#include <fmt/format.h>

#include "error.hpp"
#include "record/record.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {

Subject subject_of_record(const std::filesystem::path& path, device::Device& device) {
  const RecordSummary record = read_record(path);
  if (!record.error.empty() || record.termination == "infeasible")
    throw InputError(fmt::format("{}: a run without a part ({}); expected the record of one that ended well",
                                 path.string(), record.error.empty() ? record.termination : record.error));
  RunConfig config;
  for (const auto& [key, value] : record.config)
    if (key != "device") set_field(config, key, value);
  return subject_of_numbers(
      config, {record.model, record.length_mm, record.mass_unit_grams, record.solid, record.written}, device);
}

}  // namespace kreisel::core
