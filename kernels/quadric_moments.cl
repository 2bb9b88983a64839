// quadric_moments.cl - ten moments of the part of a bundle of vertical intervals where a quadric is negative, and
// their derivatives in its coefficients: the support oracle. [docs/quadric.md]
//
// in    lower, upper  real  [n]           ends of each interval, body units
// in    column        uint  [n]           ix | iy << 16
// out   partial       accum [groups*SUMS] one row a work-group: order s1 sx sy sz sxy syz sxz sxx syy szz, of lines of
//                                         unit density: s1 sx sy sxy sxx syy, 2 sz syz sxz and 3 szz; then,
//                                         with HESSIAN, the 35 sums over the roots inside of
//                                         x^i y^j z^k / |dq/dz|, i + j + k <= 4, by k, then i + j, then j;
//                                         the host makes the lines h x h columns
// build HESSIAN                           1: with the second part
//       WG, LANES, KREISEL_SINGLE         see real.h; arrays are padded with zeros to a multiple of GROUP: intervals
//                                         without length add nothing
// sum   a block of intervals a group, reduce10 at its end: fixed order, no atomics
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

#define INLINE static inline __attribute__((always_inline))

// Masks of comparisons are as wide as the reals they choose from; scalars compare to an int.
#if LANES == 1
#define CHOOSE(mask, yes, no) ((mask) ? (yes) : (no))
#else
#define CHOOSE(mask, yes, no) select(no, yes, mask)
#endif

// One instruction each, unlike fmin and fmax, which must look for NaNs.
INLINE reals lesser(reals a, reals b) { return CHOOSE(a < b, a, b); }
INLINE reals greater(reals a, reals b) { return CHOOSE(a > b, a, b); }

// Adds the segments [z0, z1] at (x, y); thin segments keep their digits.
INLINE void add_segments(reals* s, reals x, reals y, reals z0, reals z1) {
  const reals len = z1 - z0, sum = z0 + z1, mid = len * sum, xlen = len * x, ylen = len * y;
  s[0] += len;
  s[1] += xlen;
  s[2] += ylen;
  s[3] += mid;
  s[4] += xlen * y;
  s[5] += mid * y;
  s[6] += mid * x;
  s[7] += xlen * x;
  s[8] += ylen * y;
  s[9] += len * (z0 * z0 + z1 * sum);
}

// The roots of c + b z + a z^2 as far as they lie between, in order: [p, r]. Where there are none, p = r at the
// lower end, or the whole interval when q is linear or constant in z and negative all along.
typedef struct { reals p, r, slope; } Roots;  // slope: |dq/dz| at both roots; anything where there are none

INLINE Roots roots_between(real a, real inverse_a, reals b, reals c, reals lower, reals upper) {
  const reals discriminant = b * b - 4 * a * c;
  Roots out;
  out.slope = sqrt(discriminant);
  // No cancellation [Press et al. 2007, Numerical Recipes, s. 5.6]; a = 0 sends the first root to infinity.
  const reals t = (real)-0.5 * (b + copysign(out.slope, b));
  const reals z1 = t * inverse_a, z2 = c / t;
  const reals p = greater(lesser(lesser(z1, z2), upper), lower), r = greater(lesser(greater(z1, z2), upper), lower);
  const reals whole = a < 0 ? lower : CHOOSE(c < 0, upper, lower);
  out.p = CHOOSE(discriminant > 0, p, lower);
  out.r = CHOOSE(discriminant > 0, r, whole);
  return out;
}

#if HESSIAN
// s += w x^i y^j for all i + j up to the number in the name, by i + j, then j.
INLINE void add_powers1(reals* s, reals x, reals y, reals w) {
  s[0] += w;
  s[1] += w * x;
  s[2] += w * y;
}

INLINE void add_powers2(reals* s, reals x, reals y, reals w) {
  const reals wx = w * x, wy = w * y;
  s[0] += w;
  s[1] += wx;
  s[2] += wy;
  s[3] += wx * x;
  s[4] += wx * y;
  s[5] += wy * y;
}

INLINE void add_powers3(reals* s, reals x, reals y, reals w) {
  const reals wx = w * x, wy = w * y, wxx = wx * x, wxy = wx * y, wyy = wy * y;
  s[0] += w;
  s[1] += wx;
  s[2] += wy;
  s[3] += wxx;
  s[4] += wxy;
  s[5] += wyy;
  s[6] += wxx * x;
  s[7] += wxx * y;
  s[8] += wxy * y;
  s[9] += wyy * y;
}

INLINE void add_powers4(reals* s, reals x, reals y, reals w) {
  const reals wx = w * x, wy = w * y, wxx = wx * x, wxy = wx * y, wyy = wy * y;
  const reals wxxx = wxx * x, wxxy = wxx * y, wxyy = wxy * y, wyyy = wyy * y;
  s[0] += w;
  s[1] += wx;
  s[2] += wy;
  s[3] += wxx;
  s[4] += wxy;
  s[5] += wyy;
  s[6] += wxxx;
  s[7] += wxxy;
  s[8] += wxyy;
  s[9] += wyyy;
  s[10] += wxxx * x;
  s[11] += wxxx * y;
  s[12] += wxxy * y;
  s[13] += wxyy * y;
  s[14] += wyyy * y;
}

// The 35 sums do not fit into registers at once. So a CPU keeps a run of roots, and takes them through one group of
// sums after the other; a GPU has the registers, and keeps the roots of one interval alone.
#if LANES == 1
#define KEPT 1
#else
#define KEPT KREISEL_RUN
#endif
typedef struct { reals x[KEPT], y[KEPT], w[5][KEPT]; } Kept;  // w[k]: z^k / slope of the roots inside

INLINE void keep_roots(Kept* kept, int at, reals x, reals y, Roots roots, reals lower, reals upper) {
  const reals weight = 1 / roots.slope;
  reals p = CHOOSE((roots.p > lower) & (roots.p < upper), weight, (reals)0);
  reals r = CHOOSE((roots.r > lower) & (roots.r < upper), weight, (reals)0);
  kept->x[at] = x;
  kept->y[at] = y;
#pragma unroll
  for (int k = 0; k <= 4; ++k) {
    kept->w[k][at] = p + r;
    p *= roots.p;
    r *= roots.r;
  }
}

INLINE void add_kept(reals* s, const Kept* kept, int count) {
  for (int j = 0; j < count; ++j) add_powers4(s, kept->x[j], kept->y[j], kept->w[0][j]);
  for (int j = 0; j < count; ++j) add_powers3(s + 15, kept->x[j], kept->y[j], kept->w[1][j]);
  for (int j = 0; j < count; ++j) {
    add_powers2(s + 25, kept->x[j], kept->y[j], kept->w[2][j]);
    add_powers1(s + 31, kept->x[j], kept->y[j], kept->w[3][j]);
    s[34] += kept->w[4][j];
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
  const real a = p.q[9];
  const int end = block_end(p.block, p.n);
  for (int i = block_begin(p.block); i < end; i += KREISEL_RUN * GROUP) {
    const int count = min(KREISEL_RUN, (end - i + GROUP - 1) / GROUP);
    reals run[SUMS];
    for (int k = 0; k < SUMS; ++k) run[k] = 0;
#if HESSIAN
    Kept kept;
#endif
    for (int j = 0; j < count; ++j) {
      const int at = i + j * GROUP;
      const words packed = LOAD(at, column);
      const reals x = p.ox + p.h * TO_REALS(packed & 0xffffu), y = p.oy + p.h * TO_REALS(packed >> 16);
      const reals lo = LOAD(at, lower), hi = LOAD(at, upper);
      const reals b = p.q[3] + p.q[5] * y + p.q[6] * x;
      const reals c = p.q[0] + (p.q[1] + p.q[4] * y + p.q[7] * x) * x + (p.q[2] + p.q[8] * y) * y;
      const Roots roots = roots_between(a, p.inverse_a, b, c, lo, hi);
      if (a < 0) {  // negative outside the roots
        add_segments(run, x, y, lo, roots.p);
        add_segments(run, x, y, roots.r, hi);
      } else {
        add_segments(run, x, y, roots.p, roots.r);
      }
#if HESSIAN
      keep_roots(&kept, KEPT == 1 ? 0 : j, x, y, roots, lo, hi);
      if (KEPT == 1) add_kept(run + 10, &kept, 1);
#endif
    }
#if HESSIAN
    if (KEPT > 1) add_kept(run + 10, &kept, count);
#endif
    for (int k = 0; k < SUMS; ++k) s[k] = accum_add(s[k], run[k]);
  }
  reduce10(s, scratch, partial);
}
