// row.hpp - what a row of a table stands for, and the values that are asked of it.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "table/published.hpp"
#include "table/recorded_run.hpp"

namespace kreisel::core {

using Runs = std::vector<const RecordedRun*>;

/// The runs of a block, as its rows look among them for one to compare with.
class RunGroup {
 public:
  explicit RunGroup(Runs runs) : runs_(std::move(runs)) {}
  [[nodiscard]] const Runs& runs() const { return runs_; }
  /// Those that agree with a run in fields_of_a_ratio, itself among them. All are looked at once, at the
  /// first call.
  [[nodiscard]] const Runs& like(const RecordedRun& run) const;

 private:
  Runs runs_;
  mutable std::unordered_map<std::string, Runs> alike_;
};

/// The runs that a row is about, mostly one; with a place in a list of its record, or what a paper prints in
/// the place of a run.
struct Row {
  Runs runs;
  const RunGroup* group = nullptr;        ///< those of its block; none: a ratio has no other run
  const Published* published = nullptr;   ///< the paper's numbers, where there are any
  nlohmann::json item = nullptr;          ///< of a list in the record
  const nlohmann::json* paper = nullptr;  ///< a row of the paper that no run belongs to
};

/// "label=best", "label!=best", "label~best" (contains), or a name that has a value; "not" before it turns it
/// over.
struct Condition {
  std::string text = {};

  /// Of one run. @param item  of the row, for names that begin with "item."
  [[nodiscard]] bool holds(const RecordedRun& run, const nlohmann::json& item = nullptr) const;
  /// Of any of them.
  [[nodiscard]] bool any(const Runs& runs) const;
};

/// A name with what chooses among a row's runs: "seconds.solve[formulation=voxel]". Before it may stand
/// "converged.", "item." or "published.".
///
/// Without a choice it is of the first run that has a value; with one, of the last that it fits.
[[nodiscard]] nlohmann::json operand_of(const Row& row, std::string_view operand);

/// The values of all its runs that a choice fits, each once.
[[nodiscard]] std::vector<nlohmann::json> operands_of(const Row& row, std::string_view operand);

/// An operand, or arithmetic with them: "100 * (variables / published.variables - 1)",
/// "ratio(seconds.solve, formulation=voxel)": that of the run of the block which has this field, and else the
/// same label, model, grid and problem, over this one's; of converged runs. Null where an operand has no
/// value.
/// @throws InputError  what cannot be read
[[nodiscard]] nlohmann::json value_of(const Row& row, const std::string& expression);

/// The runs whose times arithmetic takes: of "ratio(seconds.solve, formulation=voxel)" two.
/// @throws InputError  what cannot be read
[[nodiscard]] Runs runs_in(const Row& row, const std::string& expression);

/// Fields in which the two runs of a ratio() agree.
inline constexpr std::array<std::string_view, 4> fields_of_a_ratio = {"label", "model", "grid", "problem"};

/// The operands of an expression, as they stand there.
/// @throws InputError  what cannot be read
[[nodiscard]] std::vector<std::string> names_in(const std::string& expression);

/// Whether an expression is a single operand, whose column has words and a format of its own.
[[nodiscard]] bool is_operand(std::string_view expression);

/// A text with values in it: "{label}, seed {moment.seed}", "{gap:.2f}", "{label|shapes|'none'}" (the first
/// that there is); "A || B" is B where A lacks a value. Several values of a row's runs stand beside each
/// other, " | " between them.
/// @return  nothing where a value is missing
[[nodiscard]] std::optional<std::string> text_of(const Row& row, const std::string& pattern);

}  // namespace kreisel::core
