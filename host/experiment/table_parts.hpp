// table_parts.hpp - what the tables share: the numbers of a record as they are printed.
#pragma once

#include <string>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel {

/// Half the interquartile range of `solve` over the samples, quartiles interpolated linearly; 0 for one
/// sample.
[[nodiscard]] double half_interquartile_range(const std::vector<Seconds>& samples);

/// "34.74 ± 0.12": median seconds of the solve and their spread; no spread for a single sample.
[[nodiscard]] std::string seconds_text(const RecordSummary& record);

/// "not run", "error", else the termination.
[[nodiscard]] std::string termination_text(const RecordedRun& run);

/// There is a result with numbers in it, whatever its termination.
[[nodiscard]] bool has_result(const RecordedRun& run);

/// Has a result, which is optimal.
[[nodiscard]] bool is_optimal(const RecordedRun& run);

/// "device ..., commit ..., 5 samples each": where the numbers of a table come from. One line.
[[nodiscard]] std::string provenance_text(const std::vector<RecordedRun>& runs);

/// The grid of the run, of the record where the run gives only the longest side.
[[nodiscard]] std::string grid_text(const RecordedRun& run);

}  // namespace kreisel
