// certificate.hpp - how far a result can be from the best there is: rigorous lower bounds.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "formulation/quadric_moments.hpp"
#include "solve/dual.hpp"
#include "solve/solver.hpp"
#include "solve/spin_box.hpp"

namespace kreisel::core {

struct CertifyOptions {
  double gap = 1e-3;      ///< stop when (best - bound) / |best| is no larger; > 0
  double seconds = 60;    ///< or when these are spent
  int most_boxes = 2000;  ///< or with this many
  std::stop_token stop = {};
};

/// A lower bound on a problem's objective over all interiors of a domain, and what proves it: h(q) is the
/// least q . s of any of them, and every h here was found again in double precision, less its rounding error,
/// from the multipliers alone. [docs/quadric.md, s. 4]
struct Certificate {
  /// linear      h(objective + rows^T multipliers) - bounds . multipliers >= bound
  /// ratio       h(weights^T numerators - bound denominator + rows^T multipliers) >= 0
  /// spin        every box (spin_box.hpp); the least of their values is the bound
  /// yoyo        the one box of the height 0, likewise
  /// top         boxes of heights and first moments; the least of their values and of moment sz_most^2
  /// infeasible  h(rows^T multipliers) - bounds . multipliers > 0: nothing meets the rows
  enum class Kind { linear, ratio, spin, yoyo, top, infeasible } kind = Kind::linear;
  double bound = 0;  ///< f >= bound; infinite where infeasible; -infinity where nothing could be proved
  Rows rows;         ///< the constraints that count
  Eigen::VectorXd multipliers;  ///< one a row, >= 0 for inequalities
  Moments objective = Moments::Zero(), denominator = Moments::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 10> numerators = Eigen::Matrix<double, 0, 10>();
  Eigen::VectorXd weights;          ///< one a numerator, >= 0, of sum 1
  Moments q = Moments::Zero();      ///< the quadric, where there are no boxes
  double separation = 0;            ///< of infeasible: h(q) - bounds . multipliers
  std::vector<CertifiedBox> boxes;  ///< of spin and top: upwards, from -infinity to infinity
  SpinWeights spin;
  double sz_most = 0;   ///< of top: where |sz| is larger, f is, without proof
  double contrast = 1;  ///< of the mass model that was bounded

  double best = 0;  ///< f of the best interior found on the way, cut by the quadric `best_x`
  std::vector<double> best_x;
  bool reached = false;  ///< the gap asked for, between best and bound
  double seconds = 0;
  int searches = 0;     ///< boxes solved
  std::string message;  ///< why it ended
};

[[nodiscard]] std::string_view to_string(Certificate::Kind kind);

/// Bounds the problem over a domain (rays_of): whatever formulation described an interior of it, its moments
/// are among those bounded. Solves the problem by the moment solver first, so its own best is a result as
/// good as any.
///
/// @throws Interrupted
[[nodiscard]] Certificate certify(const Problem& problem, const Rays& domain, const MassModel& mass,
                                  device::Device& device, const CertifyOptions& options);

}  // namespace kreisel::core
