// quadric_moments.cl - ten moments of the part of a bundle of vertical intervals where a quadric is negative, and
// their derivatives in its coefficients: the support oracle. [docs/quadric.md]
//
// in    lower, upper  real  [n]           ends of each interval, body units
// in    column        uint  [n]           ix | iy << 16
// out   partial       accum [groups*SUMS] one row a work-group: the moments s1 sx sy sz sxy syz sxz sxx syy szz, then,
//                                         with HESSIAN, the 35 sums over the roots inside of
//                                         area / |dq/dz| x^i y^j z^k, i + j + k <= 4, by k, then i + j, then j
// build HESSIAN                           1: with the second part
//       WG, LANES, KREISEL_SINGLE         see real.h; arrays are padded with zeros to a multiple of GROUP: intervals
//                                         without length add nothing
// sum   a block of intervals a group, reduce10 at its end: fixed order, no atomics
// An interval is an h x h column, and q counts there by its mean over the cross-section: x^2 is x^2 + h^2/12.
#ifndef HESSIAN
#define HESSIAN 0
#endif
#if HESSIAN
#define SUMS 45
#else
#define SUMS 10
#endif
#include "quadric_moments_params.h"
#include "reduce10.h"

// Masks of comparisons are as wide as the reals they choose from; scalars compare to an int.
#if LANES == 1
#define CHOOSE(mask, yes, no) ((mask) ? (yes) : (no))
#else
#define CHOOSE(mask, yes, no) select(no, yes, mask)
#endif

// Adds the moments of the segments [z0, z1] of columns at (x, y); thin segments keep their digits.
static inline void add_segments(accums* s, real area, real hh, reals x, reals y, reals z0, reals z1) {
  const reals len = area * (z1 - z0);
  const reals mid = (real)0.5 * len * (z0 + z1);
  s[0] = accum_add(s[0], len);
  s[1] = accum_add(s[1], x * len);
  s[2] = accum_add(s[2], y * len);
  s[3] = accum_add(s[3], mid);
  s[4] = accum_add(s[4], x * y * len);
  s[5] = accum_add(s[5], y * mid);
  s[6] = accum_add(s[6], x * mid);
  s[7] = accum_add(s[7], (x * x + hh) * len);
  s[8] = accum_add(s[8], (y * y + hh) * len);
  s[9] = accum_add(s[9], (real)1 / 3 * len * (z0 * z0 + z0 * z1 + z1 * z1));
}

// The roots of c + b z + a z^2 as far as they lie between, in order: [p, r]. Where there are none, p = r at the
// lower end, or the whole interval when q is linear or constant in z and negative all along.
typedef struct { reals p, r, slope; } Roots;  // slope: |dq/dz| at both roots, 0 where there are none

static inline Roots roots_between(real a, reals b, reals c, reals lower, reals upper) {
  const reals discriminant = b * b - 4 * a * c;
  const reals root = sqrt(max(discriminant, (reals)0));
  // No cancellation [Press et al. 2007, Numerical Recipes, s. 5.6]; a = 0 sends the first root to infinity.
  const reals t = (real)-0.5 * (b + copysign(root, b));
  const reals z1 = t / (reals)a, z2 = c / t;
  const reals none = lower, whole = CHOOSE(c < 0, upper, lower);
  Roots out;
  out.p = CHOOSE(discriminant > 0, clamp(fmin(z1, z2), lower, upper), none);
  out.r = CHOOSE(discriminant > 0, clamp(fmax(z1, z2), lower, upper), a < 0 ? none : whole);
  out.slope = root;
  return out;
}

#if HESSIAN
static inline reals inside(reals z, reals lower, reals upper, reals value) {
  return CHOOSE((z > lower) & (z < upper), value, (reals)0);
}

// Adds area / slope x^i y^j z^k of the roots inside, i + j + k <= 4.
static inline void add_roots(accums* s, real area, reals x, reals y, Roots roots, reals lower, reals upper) {
  const reals weight = CHOOSE(roots.slope > 0, area / roots.slope, (reals)0);
  const reals xx = x * x, xy = x * y, yy = y * y;
  const reals across[15] = {1,      x,      y,      xx,      xy,      yy,      xx * x, xx * y,
                            x * yy, yy * y, xx * xx, xx * xy, xx * yy, xy * yy, yy * yy};
  reals p = inside(roots.p, lower, upper, weight), r = inside(roots.r, lower, upper, weight);
  int at = 0;
  for (int k = 0; k <= 4; ++k) {
    const reals w = p + r;  // weight times z^k of both
    for (int j = 0; j < (5 - k) * (6 - k) / 2; ++j) {
      s[at] = accum_add(s[at], w * across[j]);
      ++at;
    }
    p *= roots.p;
    r *= roots.r;
  }
}
#endif

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void quadric_moments(QuadricParams p, global const real* lower,
                                                                            global const real* upper,
                                                                            global const uint* column,
                                                                            global accum* partial) {
  local real scratch[SCRATCH10];
  accums s[SUMS];
  for (int k = 0; k < SUMS; ++k) s[k] = (accums)ACCUM_ZERO;
  const real area = p.h * p.h, hh = area / 12;
  const real a = p.q[9] + 0;  // no negative zero: it would send the root at infinity to the wrong side
  for (int i = block_begin(p.block); i < block_end(p.block, p.n); i += GROUP) {
    const words packed = LOAD(i, column);
    const reals x = p.ox + p.h * TO_REALS(packed & 0xffffu), y = p.oy + p.h * TO_REALS(packed >> 16);
    const reals lo = LOAD(i, lower), hi = LOAD(i, upper);
    const reals b = p.q[3] + p.q[5] * y + p.q[6] * x;
    const reals c = p.q[0] + p.q[1] * x + p.q[2] * y + p.q[4] * x * y + p.q[7] * (x * x + hh) + p.q[8] * (y * y + hh);
    const Roots roots = roots_between(a, b, c, lo, hi);
    if (a < 0) {  // negative outside the roots
      add_segments(s, area, hh, x, y, lo, roots.p);
      add_segments(s, area, hh, x, y, roots.r, hi);
    } else {
      add_segments(s, area, hh, x, y, roots.p, roots.r);
    }
#if HESSIAN
    add_roots(s + 10, area, x, y, roots, lo, hi);
#endif
  }
  reduce10(s, scratch, partial);
}
