#include "record/run_arrays.hpp"

#include "formulation/formulation.hpp"

namespace kreisel::core {

using hdf5::Group;

void write_moments(Group& group, const std::string& name, const Moments& s, const char* units) {
  group.write(name, {s.data(), moment_names.size()}, {moment_names.size()},
              {units, {moment_names.begin(), moment_names.end()}});
}

void write_intervals(Group& group, const RunResult& r) {
  if (r.domain == "exact") {
    std::vector<double> ends;
    for (const ExactInterval& run : r.exact_intervals)
      ends.insert(ends.end(), {double(run.ix), double(run.iy), run.z0, run.z1});
    group.write("intervals", ends, {r.exact_intervals.size(), 4}, {"cells, L", {"ix", "iy", "z0", "z1"}});
    return;
  }
  std::vector<int> rows;
  rows.reserve(4 * r.intervals.size());
  for (const Interval& run : r.intervals) rows.insert(rows.end(), {run.ix, run.iy, run.k0, run.k1});
  group.write("intervals", rows, {r.intervals.size(), 4}, {"cells", {"ix", "iy", "k0", "k1"}});
}

void write_history(Group& group, const std::vector<Iterate>& history) {
  std::vector<double> values;
  values.reserve(7 * history.size());
  for (const Iterate& i : history)
    values.insert(values.end(), {double(i.iteration), i.objective, i.violation, i.dual_infeasibility,
                                 i.barrier, i.regularization, double(i.line_search_trials)});
  group.write("history", values, {history.size(), 7},
              {"1",
               {"iteration", "objective", "violation", "dual_infeasibility", "barrier", "regularization",
                "line_search_trials"}});
}

void write_displacement(Group& group, const DeformationReport& deformation) {
  const auto write = [&](const std::string& name, const std::vector<Vec3>& points) {
    std::vector<double> values;
    values.reserve(3 * points.size());
    for (const Vec3& p : points) values.insert(values.end(), {p[0], p[1], p[2]});
    group.write(name, values, {points.size(), 3}, {"mm", {"x", "y", "z"}});
  };
  write("vertices", deformation.before.vertices);
  write("displacement", deformation.displacement);
}

namespace {

void write_cells(Group& group, const std::vector<Cube>& cells) {
  std::vector<int> rows;
  rows.reserve(4 * cells.size());
  for (const Cube& c : cells) rows.insert(rows.end(), {c.x, c.y, c.z, c.edge});
  group.write("cells", rows, {cells.size(), 4}, {"cells", {"ix", "iy", "iz", "edge"}});
}

}  // namespace

/// What one unit of x is, in words and as a length: the ray-rep may count in cells.
void write_variables(Group& group, const RunResult& r) {
  const bool heights = find_formulation(r.config.formulation).offers.heights;
  const auto settings = settings_of(r.config, "formulation");
  const auto unit = settings.find("unit");
  const bool cells = unit == settings.end() || unit->second == "cell";
  const char* units = !heights ? "1" : cells ? "h, from the body origin" : "L, from the body origin";
  group.write("x", r.outcome.x, {r.outcome.x.size()}, {units, {}});
  group.set("x_unit_length", !heights ? 0.0 : cells ? r.grid.h : 1.0);
  if (!r.outcome.auxiliary
           .empty()) {  // those of principal_angle.hpp, the only problem with variables of its own
    group.set("phi", r.outcome.auxiliary.front());
    group.set("phi_units", "rad");
  }
  if (!r.outcome.refinements.empty()) write_cells(group, r.cells);
}

}  // namespace kreisel::core
