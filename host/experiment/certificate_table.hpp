// certificate_table.hpp - lower bounds: how near, after how many boxes and seconds.
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A row a run: objective, certified bound, gap in per cent, boxes solved on the way and seconds of the
/// certificate, which are not part of the solve's. "-" where a run was not certified.
[[nodiscard]] Tables certificate_tables(const std::vector<RecordedRun>& runs,
                                        const std::optional<Published>& published);

}  // namespace kreisel::core
