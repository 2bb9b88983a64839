#include "solve/arrow_in_ipopt.hpp"

#include <HSLLoader.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "solve/arrow.hpp"

namespace kreisel::core {
namespace {

/// The systems of the solve that is running. Ipopt has one, and more where a phase of its own has another
/// structure; the number of each is kept in the integer workspaces, which Ipopt hands from call to call.
std::vector<std::unique_ptr<Arrow>> systems;  // NOLINT: as global as the hook it serves

enum Info { status = 0, detail = 1, real_words = 4, integer_words = 5, negative = 14 };
constexpr int length_of_info = 20;
enum Status { done = 0, singular = 3, failed = -7 };

std::span<const int> span_of(const ipfint* first, ipfint count) {
  return {first, static_cast<std::size_t>(count)};
}

Arrow* system_of(ipfint number) {
  const auto k = static_cast<std::size_t>(number);
  return k < systems.size() ? systems[k].get() : nullptr;
}

/// Defaults: Ipopt overwrites those that it cares for.
void set_defaults(ipfint* icntl, double* cntl) {
  std::fill_n(icntl, 30, 0);
  std::fill_n(cntl, 5, 0.0);
}

/// Looks at the structure. Ipopt then allocates workspaces as asked and puts its values into one of them.
void analyse(ipfint* n, ipfint* entries, const ipfint* rows, const ipfint* columns, ipfint*, ipfint*,
             ipfint* keep, ipfint*, ipfint* steps, ipfint*, ipfint*, double*, ipfint* info, double*) {
  std::fill_n(info, length_of_info, 0);
  info[real_words] = info[integer_words] = std::max<ipfint>(*entries, 1);
  *steps = 1;
  auto system = Arrow::of({*n, 1, span_of(rows, *entries), span_of(columns, *entries)});
  if (!system) {
    info[status] = failed;
    return;
  }
  *keep = static_cast<ipfint>(systems.size());
  systems.push_back(std::move(system));
}

void factor(ipfint* n, ipfint* entries, const ipfint*, const ipfint*, double* values, ipfint*, ipfint* work,
            ipfint*, ipfint* keep, ipfint*, ipfint* front, ipfint*, ipfint*, double* cntl, ipfint* info) {
  std::fill_n(info, length_of_info, 0);
  *front = 1;  // words of the workspace of a solve, which needs none
  Arrow* const system = system_of(*keep);
  if (!system) {
    info[status] = failed;
    return;
  }
  *work = *keep;
  // CNTL(1) is the threshold of partial pivoting. Ipopt raises it when a solution is not good enough, where
  // it looks at that at all: not with fast_step_computation.
  const double growth = 1 / std::max(cntl[0], std::numeric_limits<double>::epsilon());
  if (!system->factor({values, static_cast<std::size_t>(*entries)}, growth)) {
    info[status] = singular;
    info[detail] = *n - 1;  // a rank that is too small, as it asks for; which one it has is not known
  }
  info[negative] = system->negative();
}

void solve(ipfint* n, double*, ipfint*, ipfint* work, ipfint*, double*, ipfint*, double* right, ipfint*,
           ipfint*, ipfint*, double*) {
  system_of(*work)->solve({right, static_cast<std::size_t>(*n)});
}

}  // namespace

bool is_arrow(Ipopt::TNLP& nlp, bool exact) {
  Ipopt::Index n = 0, m = 0, jacobian = 0, hessian = 0;
  Ipopt::TNLP::IndexStyleEnum style{};
  nlp.get_nlp_info(n, m, jacobian, hessian, style);
  if (!exact) hessian = 0;
  std::vector<double> x_l(static_cast<std::size_t>(n)), x_u(x_l), g_l(static_cast<std::size_t>(m)), g_u(g_l);
  nlp.get_bounds_info(n, x_l.data(), x_u.data(), m, g_l.data(), g_u.data());
  // [ W + D  J^T ]  with a slack for each row of J that is not an equation.
  // [ J      -E  ]
  std::vector<Ipopt::Index> rows(static_cast<std::size_t>(hessian + jacobian)), columns(rows);
  if (hessian > 0)
    nlp.eval_h(n, nullptr, false, 1, m, nullptr, false, hessian, rows.data(), columns.data(), nullptr);
  nlp.eval_jac_g(n, nullptr, false, m, jacobian, rows.data() + hessian, columns.data() + hessian, nullptr);
  for (auto row = rows.begin() + hessian; row != rows.end(); ++row) *row += n;
  Ipopt::Index size = n + m;
  for (Ipopt::Index r = 0; r < m; ++r)
    if (g_l[static_cast<std::size_t>(r)] < g_u[static_cast<std::size_t>(r)]) {
      rows.push_back(size++);
      columns.push_back(n + r);
    }
  return ArrowShape::of({size, 0, rows, columns}).has_value();
}

ArrowInIpopt::ArrowInIpopt() {
  systems.clear();
  LSL_setMA27(analyse, factor, solve, set_defaults);
}

ArrowInIpopt::~ArrowInIpopt() { systems.clear(); }

}  // namespace kreisel::core
