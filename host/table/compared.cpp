#include "table/compared.hpp"

#include <algorithm>
#include <memory>

#include "table/columns.hpp"
#include "table/row.hpp"
#include "table/table_kinds.hpp"

namespace kreisel::core {
namespace {

template <class Names>
std::string values_of(const RecordedRun& run, const Names& names) {
  std::string all;
  for (const auto& name : names) all += value_of(run, name).dump() + '\n';
  return all;
}

std::string compared_by(const Layout& layout, const RecordedRun& run) {
  if (!layout.rows.empty()) return values_of(run, layout.groups) + values_of(run, layout.rows);
  const bool divides = std::ranges::any_of(
      layout.columns, [](const LayoutColumn& c) { return c.value.find("ratio(") != std::string::npos; });
  return divides ? values_of(run, fields_of_a_ratio) : std::string();
}

}  // namespace

ComparedAs compared_in(const std::string& table, std::shared_ptr<const Layout> layout) {
  if (!layout)
    if (const TableKind* kind = find_table_kind(table))
      return [kind](const RecordedRun& run) { return values_of(run, kind->compares); };
  if (!layout) layout = std::make_shared<const Layout>(find_layout(table));
  return [layout](const RecordedRun& run) { return compared_by(*layout, run); };
}

}  // namespace kreisel::core
