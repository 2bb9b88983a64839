// support_oracle.hpp - what a domain tells of all its fillings at once.
#pragma once

#include "body/moments.hpp"

namespace kreisel::core {

/// What one pass over a domain tells of a quadric q = q . (1 x y z xy yz xz xx yy zz).
struct Support {
  Moments moments = Moments::Zero();    ///< s(q), of the part where q < 0, at unit density
  double value = 0;                     ///< h(q) = q . s(q), the least q . s of any filling
  Matrix10 hessian = Matrix10::Zero();  ///< d2h/dq2 = ds/dq, negative semidefinite; zero when not asked for
};

/// The support function h(q) = min q . s over the attainable moments s of a domain, from fine to coarse.
/// [docs/quadric.md]
class SupportOracle {
 public:
  virtual ~SupportOracle() = default;

  /// Level 0 is the domain itself; each further one has about a quarter of the rays of the one before.
  [[nodiscard]] virtual int levels() const = 0;
  [[nodiscard]] virtual Support support(int level, const Moments& q, bool with_hessian) = 0;
};

}  // namespace kreisel::core
