// table_parts.hpp - what the tables share: the numbers of a record as they are printed.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/provenance_text.hpp"
#include "experiment/table.hpp"

namespace kreisel::core {

/// Half the interquartile range of `solve` over the samples.
[[nodiscard]] double half_interquartile_range(const std::vector<Seconds>& samples);

/// "34.74 ± 0.12": median seconds of the solve and their spread; no spread for a single sample.
[[nodiscard]] std::string seconds_text(const RecordSummary& record);

/// "not run", "error", else the termination.
[[nodiscard]] std::string termination_text(const RecordedRun& run);

/// There is a result with numbers in it, whatever its termination.
[[nodiscard]] bool has_result(const RecordedRun& run);

/// Has a result, which is optimal.
[[nodiscard]] bool is_optimal(const RecordedRun& run);

/// Has a result that a time or an objective may be compared with: optimal or acceptable. What a solve that
/// gave up took says nothing.
[[nodiscard]] bool is_converged(const RecordedRun& run);

/// The grid of the run, of the record where the run gives only the longest side.
[[nodiscard]] std::string grid_text(const RecordedRun& run);

/// The row of the paper with that model, grid and problem, or nullptr.
[[nodiscard]] const PublishedRow* find_row(const RecordedRun& run, const std::optional<Published>& published);

inline constexpr std::string_view certified_legend =
    "gap %: f lies no further above the least that any interior of the domain has, certified\n";

/// Does any of them have a certificate? Tables have a column for the gap then.
[[nodiscard]] bool any_certified(const std::vector<RecordedRun>& runs);

/// How far f may be above the least there is, per cent; "-" without a certificate.
[[nodiscard]] Cell gap_cell(const RecordedRun& run);

/// A line that says why a run has no result or, if asked, none that is optimal. Empty where all is well.
/// @param name  what the table calls the run; empty: as run_text() does
[[nodiscard]] std::string note_of(const RecordedRun& run, bool unless_optimal = true, std::string name = {});

/// A sheet with a row a run. Its columns open with label, model and grid, and what is solved by which
/// formulation; `more` follow. @param labels  are to be seen
[[nodiscard]] Sheet sheet_of_runs(std::vector<Sheet::Column> more, bool labels = true);
/// The cells with which a row of that opens.
[[nodiscard]] std::vector<Cell> opening_cells(const RecordedRun& run);

/// "paper: SOURCE; MACHINE", a line; empty without one.
[[nodiscard]] std::string paper_text(const std::optional<Published>& published);

/// The cells that most tables have, "-" without a result.
struct SolveCells {
  explicit SolveCells(const RecordedRun& run);
  Cell variables = Cell::none(), iterations = Cell::none(), seconds = Cell::none(), half_iqr = Cell::none(),
       setup = Cell::none(),  ///< seconds from the model to its columns: what comes before every solve
      samples = Cell::none(), objective = Cell::none(), violation = Cell::none(), verified = Cell::none(),
       device = Cell::none(), commit = Cell::none();
};

/// The first item that matches, else a new one at the end.
template <class Item, class Matches, class Make>
Item& find_or_add(std::vector<Item>& items, Matches matches, Make make) {
  const auto at = std::find_if(items.begin(), items.end(), matches);
  return at != items.end() ? *at : items.emplace_back(make());
}

}  // namespace kreisel::core
