#include "table/inertia_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "table/experiment_run.hpp"
#include "table/table_parts.hpp"

namespace kreisel::core {
namespace {

using Eigen::Matrix3d;

constexpr std::array<const char*, 6> components = {"Ixx", "Iyy", "Izz", "Ixy", "Iyz", "Ixz"};

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
  for (const char* name : components) columns.push_back({fmt::format("{}_g_cm2", name), "g cm^2", name});
  for (const char* name : components)
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

/// Ten moments of a record; zero where it has none.
Moments moments_in(const RecordedRun& run, std::string_view name) {
  Moments s = Moments::Zero();
  const nlohmann::json list = run.at(name);
  for (std::size_t k = 0; list.is_array() && k < list.size() && k < moment_names.size(); ++k)
    s[static_cast<Eigen::Index>(k)] = list[k].is_number() ? list[k].get<double>() : 0;
  return s;
}

Block block_of(const RecordedRun& run, const std::optional<Published>& published) {
  std::string heading = run_text(run.run);
  for (const auto& [name, value] : fields_of(run.run))
    if (name.find('.') != std::string::npos) heading += fmt::format(", {}={}", name, value);
  Block block{heading, inertia_sheet(), note_of(run)};
  if (run.has_result()) {
    const double length = run.number("frame.length").value_or(1);
    const double unit = run.number("frame.mass").value_or(1) * length * length / 100;  // M L^2 in g cm^2
    const Moments solid = moments_in(run, "solid_moments_body");
    const Matrix3d before = unit * inertia_about_centre(solid);
    const auto add = [&](const char* body, const Moments& s) {
      if (s[S1] > 0) add_row(block.sheet, heading, body, unit * inertia_about_centre(s), before(2, 2));
    };
    add("solid", solid);
    add("optimum", moments_in(run, "moments_body"));
    add("as written", moments_in(run, "verified.moments_body"));
    if (const nlohmann::json text = run.at("verified.text"); text.is_string())
      block.notes += fmt::format("verified: {}\n", text.get<std::string>());
  } else if (!run.record) {
    block.notes += "not run\n";
  }
  const nlohmann::json* row = published ? published->find(run) : nullptr;
  if (row && row->contains("inertia")) {
    using Six = std::array<double, 6>;
    const Matrix3d before = matrix_of(row->at("inertia").at("before").get<Six>()),
                   after = matrix_of(row->at("inertia").at("after").get<Six>());
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
      provenance_text(pointers(runs)) + '\n';
  if (published) tables.legend += fmt::format("paper: {}\n", published->source);
  return tables;
}

}  // namespace kreisel::core
