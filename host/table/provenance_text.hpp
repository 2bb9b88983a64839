// provenance_text.hpp - where the numbers of a table come from, in a line.
#pragma once

#include <string>

#include "table/row.hpp"

namespace kreisel::core {

/// "device a device; commit abc1234; 2026-11-28; load 0.2 to 1.9; 3 samples each", of the records there are:
/// devices, commits, days (UTC), load of the machine when each run began, timed solves. "5 of 7 runs" ends it
/// where some have no record; "no records yet" without any.
[[nodiscard]] std::string provenance_text(const Runs& runs);

}  // namespace kreisel::core
