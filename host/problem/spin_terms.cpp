#include "problem/spin_terms.hpp"

namespace kreisel::core {

Shift::Shift(const Moments& s) {
  const double m = s[S1], z = s[SZ] / m;
  value = s[SZ] * z;
  gradient.setZero();
  gradient[S1] = -z * z;
  gradient[SZ] = 2 * z;
  hessian.setZero();
  hessian(S1, S1) = 2 * z * z / m;
  hessian(SZ, SZ) = 2 / m;
  hessian(S1, SZ) = hessian(SZ, S1) = -2 * z / m;
}

double height_value(const SpinWeights& w, const Moments& s) {
  const double c = s[SZ] / s[S1];
  return w.lambda * c + w.height * c * c + w.moment * s[SZ] * s[SZ];
}

Moments height_gradient(const SpinWeights& w, const Moments& s) {
  const double c = s[SZ] / s[S1], rate = (w.lambda + 2 * w.height * c) / s[S1];
  Moments g = Moments::Zero();
  g[SZ] = rate + 2 * w.moment * s[SZ];
  g[S1] = -rate * c;
  return g;
}

Matrix10 height_hessian(const SpinWeights& w, const Moments& s) {
  const double m = s[S1], c = s[SZ] / m, rate = (w.lambda + 2 * w.height * c) / (m * m),
               bend = 2 * w.height / (m * m);
  Matrix10 h = Matrix10::Zero();
  h(SZ, SZ) = bend + 2 * w.moment;
  h(SZ, S1) = h(S1, SZ) = -rate - bend * c;
  h(S1, S1) = 2 * rate * c + bend * c * c;
  return h;
}

}  // namespace kreisel::core
