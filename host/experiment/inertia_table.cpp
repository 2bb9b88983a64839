#include "experiment/inertia_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

using Eigen::Matrix3d;

constexpr std::array<const char*, 6> names = {"Ixx", "Iyy", "Izz", "Ixy", "Iyz", "Ixz"};

std::array<double, 6> six_of(const Matrix3d& i) {
  return {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(1, 2), i(0, 2)};
}

Matrix3d matrix_of(const std::array<double, 6>& i) {
  Matrix3d m;
  m << i[0], i[3], i[5], i[3], i[1], i[4], i[5], i[4], i[2];
  return m;
}

Sheet inertia_sheet() {
  std::vector<Sheet::Column> columns = {{"run", "", ""}, {"body", "", "body", true}};
  for (const char* name : names) columns.push_back({fmt::format("{}_g_cm2", name), "g cm^2", name});
  for (const char* name : names)
    columns.push_back({fmt::format("{}_over_Izz_before", name), "relative to Izz before", name});
  for (const int i : {1, 2, 3})
    columns.push_back({fmt::format("principal_{}_g_cm2", i), "principal, g cm^2", fmt::format("I{}", i)});
  columns.push_back({"tilt_degrees", "z axis", "tilt, deg"});
  columns.push_back({"z_largest", "z axis", "largest", true});
  return Sheet(std::move(columns));
}

void add_row(Sheet& sheet, const std::string& run, const std::string& body, const Matrix3d& inertia,
             double izz_before) {
  const PrincipalAxes principal(inertia);
  std::vector<Cell> row = {run, body};
  for (const double value : six_of(inertia)) row.push_back(Cell::of(value, "{:.2f}"));
  for (const double value : six_of(inertia)) row.push_back(Cell::of(value / izz_before, "{:.4f}"));
  for (const double value : principal.moments) row.push_back(Cell::of(value, "{:.2f}"));
  row.push_back(Cell::of(principal.tilt_degrees(), "{:.3f}"));
  row.emplace_back(principal.nearest_to_z() == 2 ? "yes" : "no");
  sheet.add(std::move(row));
}

Block block_of(const RecordedRun& run, const std::optional<Published>& published) {
  std::string heading = run_text(run.run);
  for (const auto& [name, value] : run.run.asked().settings) heading += fmt::format(", {}={}", name, value);
  Block block{heading, inertia_sheet(), note_of(run)};
  if (has_result(run)) {
    const RecordSummary& r = *run.record;
    const double unit = r.mass_unit_grams * r.length_mm * r.length_mm / 100;  // M L^2 in g cm^2
    const Matrix3d before = unit * inertia_about_centre(r.solid);
    const auto add = [&](const char* body, const Moments& s) {
      if (s[S1] > 0) add_row(block.sheet, heading, body, unit * inertia_about_centre(s), before(2, 2));
    };
    add("solid", r.solid);
    add("optimum", r.optimum);
    add("as written", r.written);
    block.notes += fmt::format("verified: {}\n", r.verified_text);
  } else if (!run.record) {
    block.notes += "not run\n";
  }
  if (const PublishedRow* row = find_row(run, published); row && row->inertia) {
    const Matrix3d before = matrix_of(row->inertia->before), after = matrix_of(row->inertia->after);
    add_row(block.sheet, heading, "paper, before", before, before(2, 2));
    add_row(block.sheet, heading, "paper, after", after, before(2, 2));
  }
  return block;
}

}  // namespace

Tables inertia_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  Tables tables;
  for (const RecordedRun& run : runs) tables.blocks.push_back(block_of(run, published));
  tables.legend =
      "about the centre of mass, axes of the body frame (z: spin axis); Ixy, Iyz, Ixz: elements of the "
      "tensor, minus the products of inertia;\n"
      "the paper's rows are as printed there, unit and sign of the products not stated; tilt: between z and "
      "the nearest principal axis\n" +
      provenance_text(runs) + '\n';
  if (published) tables.legend += fmt::format("paper: {}\n", published->source);
  return tables;
}

}  // namespace kreisel::core
