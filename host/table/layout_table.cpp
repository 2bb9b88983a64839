#include "table/layout_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "table/across_nodes.hpp"
#include "table/columns.hpp"
#include "table/experiment_run.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

/// Rows of a block, and what is said above and below them.
struct LaidBlock {
  std::unique_ptr<RunGroup> group;  ///< stays where it is, for its rows
  std::vector<Row> rows;
};

class Setter {
 public:
  Setter(const Layout& layout, const std::vector<RecordedRun>& runs, const Published* published)
      : layout_(layout), published_(published) {
    for (const RecordedRun& run : runs) all_.push_back(&run);
    for (const LayoutColumn& column : layout_.columns)
      if (all_hold(column.when)) columns_.push_back(&column);
  }

  Tables tables() {
    Tables tables;
    std::vector<LaidBlock> blocks = laid_out();
    std::vector<const json*> left = papers_own_rows();
    for (const LaidBlock& block : blocks) {
      Block made = made_of(block);
      if (!layout_.paper_rows_in.empty())
        for (const json* row : left)
          if (const json begins = value_in(*row, layout_.paper_rows_in);
              begins.is_string() && made.heading.starts_with(begins.get<std::string>() + " "))
            made.sheet.add(cells_of_paper(*row, made.heading));
      tables.blocks.push_back(std::move(made));
    }
    if (layout_.paper_rows_in.empty() && !tables.blocks.empty())
      for (const json* row : left)
        tables.blocks.back().sheet.add(cells_of_paper(*row, tables.blocks.back().heading));
    const Row whole = row_of_all(all_);
    for (const LayoutLine& line : layout_.legend)
      if (all_hold(line.when))
        if (const auto text = text_of(whole, line.pattern)) tables.legend += *text + '\n';
    tables.legend += across_nodes_legend(tables);
    return tables;
  }

 private:
  /// For some run; "published" where there are a paper's numbers.
  [[nodiscard]] bool holds(const Condition& condition) const {
    if (condition.text == "published") return published_ != nullptr;
    if (condition.text == "not published") return published_ == nullptr;
    return condition.any(all_);
  }
  [[nodiscard]] bool all_hold(const std::vector<Condition>& conditions) const {
    return std::ranges::all_of(conditions, [&](const Condition& c) { return holds(c); });
  }
  [[nodiscard]] Row row_of_all(const Runs& runs) const { return {runs, nullptr, published_}; }

  [[nodiscard]] std::string key_of(const RecordedRun& run, const std::vector<std::string>& names) const {
    std::string key;
    for (const std::string& name : names) key += cell_of(value_of(run, name), "", ",").data + '\n';
    return key;
  }

  std::vector<LaidBlock> laid_out() const {
    std::vector<Runs> blocks;
    std::unordered_map<std::string, std::size_t> known;
    const bool each_run = layout_.groups == std::vector<std::string>{"run"};
    for (const RecordedRun* run : all_) {
      const std::string key = each_run ? fmt::format("{}", blocks.size()) : key_of(*run, layout_.groups);
      const auto [at, is_new] = known.try_emplace(key, blocks.size());
      if (is_new) blocks.emplace_back();
      blocks[at->second].push_back(run);
    }
    if (blocks.empty() && layout_.groups.empty()) blocks.emplace_back();
    std::vector<LaidBlock> laid;
    for (Runs& runs : blocks) {
      auto group = std::make_unique<RunGroup>(std::move(runs));
      std::vector<Row> rows = rows_of(*group);
      laid.push_back({std::move(group), std::move(rows)});
    }
    return laid;
  }

  std::vector<Row> rows_of(const RunGroup& group) const {
    std::unordered_map<std::string, std::size_t> known;
    std::vector<Row> rows;
    for (const RecordedRun* run : group.runs()) {
      if (layout_.only && !layout_.only->holds(*run)) continue;
      if (!layout_.rows.empty()) {
        const auto [at, is_new] = known.try_emplace(key_of(*run, layout_.rows), rows.size());
        if (!is_new) {
          rows[at->second].runs.push_back(run);
          continue;
        }
      }
      for (Row& row : rows_of_run(*run, group)) rows.push_back(std::move(row));
    }
    if (layout_.as_published && published_)
      std::ranges::stable_sort(rows, {}, [&](const Row& row) { return place_in_paper(row); });
    return rows;
  }

  std::vector<Row> rows_of_run(const RecordedRun& run, const RunGroup& group) const {
    if (layout_.each.empty()) return {Row{{&run}, &group, published_}};
    std::vector<Row> rows;
    const json list = run.at(layout_.each);
    for (std::size_t i = 0; list.is_array() && i < list.size(); ++i) {
      rows.push_back({{&run}, &group, published_, list[i].is_object() ? list[i] : json{{"value", list[i]}}});
      rows.back().item["index"] = i + 1;
    }
    // A run without a record has a row of what was asked, where the others have several.
    if (list.is_null() && !layout_.only) rows.push_back({{&run}, &group, published_});
    return rows;
  }

  [[nodiscard]] std::size_t place_in_paper(const Row& row) const {
    std::size_t place = published_->rows.size();
    for (const RecordedRun* run : row.runs)
      if (const json* found = published_->find(*run))
        place = static_cast<std::size_t>(
            std::ranges::find_if(published_->rows, [&](const json& r) { return &r == found; }) -
            published_->rows.begin());
    return place;
  }

  std::vector<const json*> papers_own_rows() const {
    std::vector<const json*> own;
    if (!published_ || layout_.paper_rows.empty()) return own;
    for (const json& row : published_->rows)
      if (row.contains(layout_.paper_rows) &&
          (!layout_.paper_rows_in.empty() ||
           std::ranges::none_of(all_, [&](const RecordedRun* run) { return belongs(row, *run); })))
        own.push_back(&row);
    return own;
  }

  [[nodiscard]] Sheet sheet() const {
    std::vector<Sheet::Column> headings;
    for (const LayoutColumn* column : columns_) {
      const bool hidden = !column->hidden_when.empty() && all_hold(column->hidden_when);
      headings.push_back({column->name, column->group, column->heading, column->left, hidden});
    }
    return Sheet(std::move(headings));
  }

  Block made_of(const LaidBlock& laid) const {
    Block block{"", sheet(), ""};
    const Row whole = row_of_all(laid.group->runs());
    for (const std::string& pattern : layout_.heading)
      if (const auto line = text_of(whole, pattern))
        block.heading += (block.heading.empty() ? "" : "\n") + *line;
    const RecordedRun* before = nullptr;
    for (const Row& row : laid.rows) {
      std::vector<Cell> cells;
      const bool again = !row.item.is_null() && row.runs.front() == before;
      for (const LayoutColumn* column : columns_) cells.push_back(cell(*column, row, block.heading, again));
      block.sheet.add(std::move(cells));
      before = row.runs.front();
    }
    if (layout_.rows.empty())
      for (const RecordedRun* run : laid.group->runs()) block.notes += note(*run);
    else  // in the order of the rows
      for (const Row& row : laid.rows)
        for (const RecordedRun* run : row.runs) block.notes += note(*run);
    for (const std::string& pattern : layout_.footer)
      if (const auto line = text_of(whole, pattern)) block.notes += *line + '\n';
    return block;
  }

  [[nodiscard]] std::string note(const RecordedRun& run) const {
    if (layout_.notes == Layout::Notes::missing && !run.has_result())
      return fmt::format("{}: {}\n", run_text(run.run),
                         run.record ? "error - " + run.record->error : "not run");
    const Row row{{&run}, nullptr, published_};
    const std::string name = layout_.note.empty() ? "" : text_of(row, layout_.note).value_or("");
    return layout_.notes == Layout::Notes::missing
               ? ""
               : note_of(run, layout_.notes == Layout::Notes::unless_optimal, name);
  }

  [[nodiscard]] static Cell cell(const LayoutColumn& column, const Row& row, const std::string& heading,
                                 bool again) {
    if (column.value == "heading") return heading;
    if (column.blank_when && column.blank_when->holds(*row.runs.front(), row.item)) return Cell::none();
    if (column.value.find('{') != std::string::npos) return text_of(row, column.value).value_or("");
    Cell made = cell_of(value_of(row, column.value), column.format, column.join);
    if (const Column* known = find_column(named_in(column.value)); known && known->text)
      if (const RecordedRun* run = run_of(row, column.value)) made.text = known->text(*run);
    if (!made.data.empty() && is_across_nodes(row, column.value)) mark_across_nodes(made);
    if (again && column.once) made.text.clear();
    if (column.parentheses_when && column.parentheses_when->holds(*row.runs.front(), row.item))
      made = {made.data.empty() ? made.text : '(' + made.text + ')', ""};
    return made;
  }

  /// The name of an operand, without what chooses the run.
  static std::string_view named_in(std::string_view value) {
    return is_operand(value) ? value.substr(0, value.find('[')) : std::string_view();
  }
  /// The run that an operand is of.
  static const RecordedRun* run_of(const Row& row, std::string_view value) {
    const std::size_t bracket = value.find('[');
    if (bracket == value.npos) return row.runs.front();
    const Condition choice{std::string(value.substr(bracket + 1, value.size() - bracket - 2))};
    const RecordedRun* found = nullptr;
    for (const RecordedRun* run : row.runs)
      if (choice.holds(*run)) found = run;
    return found;
  }

  std::vector<Cell> cells_of_paper(const json& row, const std::string& heading) const {
    std::vector<Cell> cells;
    for (const LayoutColumn* column : columns_) {
      if (column->value == "heading")
        cells.emplace_back(heading);
      else if (column->paper.starts_with('\''))
        cells.emplace_back(column->paper.substr(1, column->paper.size() - 2));
      else
        cells.push_back(column->paper.empty() ? Cell::none()
                                              : cell_of(value_in(row, column->paper), "g", ", "));
    }
    return cells;
  }

  const Layout& layout_;
  const Published* published_;
  Runs all_;
  std::vector<const LayoutColumn*> columns_;
};

}  // namespace

Tables tables_of(const Layout& layout, const std::vector<RecordedRun>& runs,
                 const std::optional<Published>& published) {
  return Setter(layout, runs, published ? &*published : nullptr).tables();
}

}  // namespace kreisel::core
