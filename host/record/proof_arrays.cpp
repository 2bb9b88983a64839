#include <cmath>
#include <utility>

#include "record/run_arrays.hpp"

namespace kreisel::core {
namespace {

const std::vector<std::string>& moment_columns() {
  static const std::vector<std::string> names(moment_names.begin(), moment_names.end());
  return names;
}

void write_forms(hdf5::Group& group, const std::string& name,
                 const Eigen::Matrix<double, Eigen::Dynamic, 10>& forms) {
  const Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor> rows = forms;
  group.write(name, {rows.data(), static_cast<std::size_t>(rows.size())},
              {static_cast<std::size_t>(rows.rows()), 10}, {"per body unit", moment_columns()});
}

void write_list(hdf5::Group& group, const std::string& name, const Eigen::VectorXd& values) {
  const auto n = static_cast<std::size_t>(values.size());
  group.write(name, {values.data(), n}, {n}, {"1", {}});
}

/// Of a top the columns go on with first moments, and quadrics with those at sz_high.
void write_boxes(hdf5::Group& group, const std::vector<CertifiedBox>& boxes, bool top) {
  std::vector<std::string> columns = {"c_low", "c_high", "empty", "value", "t_low", "t_high", "u1",
                                      "u2",    "u3",     "mu_x",  "mu_y",  "mu_xz", "mu_yz",  "nu"};
  if (top) columns.insert(columns.end(), {"sz_low", "sz_high", "t_low_above", "t_high_above", "kappa"});
  std::vector<double> values, quadrics;
  for (const CertifiedBox& b : boxes) {
    values.insert(values.end(), {b.low, b.high, b.empty ? 1.0 : 0.0, b.value, b.t_low, b.t_high, b.u[0],
                                 b.u[1], b.u[2], b.mu[0], b.mu[1], b.mu[2], b.mu[3], b.nu});
    if (top) values.insert(values.end(), {b.sz_low, b.sz_high, b.t_low_above, b.t_high_above, b.kappa});
    std::vector<std::pair<double, double>> corners = {{b.low, b.t_low}, {b.high, b.t_high}};
    if (top) corners.insert(corners.end(), {{b.low, b.t_low_above}, {b.high, b.t_high_above}});
    for (const auto& [c, t] : corners) {
      const Moments q = std::isfinite(c) ? b.quadric(c, t) : Moments::Zero();
      quadrics.insert(quadrics.end(), q.begin(), q.end());
    }
  }
  const std::size_t corners = boxes.empty() ? 0 : quadrics.size() / 10;
  group.write("boxes", values, {boxes.size(), columns.size()}, {"body units", columns});
  group.write("box_quadrics", quadrics, {corners, 10}, {"per body unit", moment_columns()});
}

}  // namespace

void write_proof(hdf5::Group& group, const Certificate& c) {
  group.set("separation", c.separation);
  group.set("contrast", c.contrast);
  group.set("lambda", c.spin.lambda);
  group.set("height", c.spin.height);
  group.set("moment", c.spin.moment);
  group.set("sz_most", c.sz_most);
  group.set("gamma_i", c.spin.gamma_i);
  write_forms(group, "q", c.q.transpose());
  write_forms(group, "rows", c.rows.matrix);
  write_list(group, "bounds", c.rows.bound);
  const std::vector<int> equality(c.rows.equality.begin(), c.rows.equality.end());
  group.write("equality", equality, {equality.size()}, {"1", {}});
  write_list(group, "multipliers", c.multipliers);
  write_forms(group, "objective", c.objective.transpose());
  write_forms(group, "numerators", c.numerators);
  write_list(group, "weights", c.weights);
  write_forms(group, "denominator", c.denominator.transpose());
  write_boxes(group, c.boxes, c.kind == Certificate::Kind::top);
}

}  // namespace kreisel::core
