// ray_moments.cl - ten moments of the solid segments of a bundle of rays, and their derivatives. [RayRep, s. 3.1]
//
// in    x        real  [VARS*n]    the ends that vary, in units of p.unit: z0 and z1 of each ray, interleaved, or
//                                  one of them
// in    column   uint  [n]         ix | iy << 16
// in    fixed    real  [n]         the other end of each ray when only one varies; else not read
// out   partial  accum [groups*10] one row a work-group, order s1 sx sy sz sxy syz sxz sxx syy szz,
//                                  of lines of unit density: s1 sx sy sxy sxx syy, 2 sz syz sxz and 3 szz;
//                                  the host makes them h x h columns
// build ENDS                       1: z0 varies, 2: z1 varies, 3: both
//       WG, LANES, KREISEL_SINGLE  see real.h; arrays are padded with zeros to a multiple of GROUP, p.n counts the
//                                  padding
// sum   a block of elements a group, reduce10 at its end: fixed order, no atomics
// the integral along z is exact
#include "ray_moments_params.h"
#include "reduce10.h"

#ifndef ENDS
#define ENDS 3
#endif
#define VARS (ENDS == 3 ? 2 : 1)
// Material grows with z1 and shrinks with z0; `end` counts the ends that vary.
#define SIGN(end) ((real)(ENDS == 1 || (ENDS == 3 && (end) == 0) ? -1 : 1))

typedef struct { reals x, y; } Columns;
typedef struct { reals z0, z1; } Segments;

static inline void load_ends(reals* z, int i, global const real* x) {
#if ENDS == 3
  LOAD_PAIRS(z[0], z[1], i, x);
#else
  z[0] = LOAD(i, x);
#endif
}

static inline void store_ends(const reals* v, int i, global real* out) {
#if ENDS == 3
  STORE_PAIRS(v[0], v[1], i, out);
#else
  STORE(v[0], i, out);
#endif
}

static inline Segments segments_at(const RayParams* p, global const real* x, global const real* fixed, int i) {
  reals z[VARS];
  load_ends(z, i, x);
  Segments s;
  s.z0 = p->unit * (ENDS == 2 ? LOAD(i, fixed) : z[0]);
  s.z1 = p->unit * (ENDS == 1 ? LOAD(i, fixed) : z[VARS - 1]);
  return s;
}

static inline Columns columns_at(const RayParams* p, words packed) {
  Columns c;
  c.x = p->ox + p->h * TO_REALS(packed & 0xffffu);
  c.y = p->oy + p->h * TO_REALS(packed >> 16);
  return c;
}

// The polynomial w[0] + w[1] x + .. + w[9] z^2, coefficients in the order of the moments, along a ray:
// a[0] + a[1] z + a[2] z^2. It is the derivative by z1, which the host has averaged over a column.
static inline void along_ray(Columns c, global const real* w, reals* a) {
  a[0] = w[0] + (w[1] + w[4] * c.y + w[7] * c.x) * c.x + (w[2] + w[8] * c.y) * c.y;
  a[1] = w[3] + w[5] * c.y + w[6] * c.x;
  a[2] = w[9];
}

// Written with the factor (z1 - z0), so that thin segments keep their digits.
static inline void add_rays(reals* s, Columns c, Segments segment) {
  const reals z0 = segment.z0, z1 = segment.z1, len = z1 - z0, sum = z0 + z1, mid = len * sum;
  const reals x = len * c.x, y = len * c.y;
  s[0] += len;
  s[1] += x;
  s[2] += y;
  s[3] += mid;
  s[4] += x * c.y;
  s[5] += mid * c.y;
  s[6] += mid * c.x;
  s[7] += x * c.x;
  s[8] += y * c.y;
  s[9] += len * (z0 * z0 + z1 * sum);
}

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void ray_moments(RayParams p, global const real* x,
                                                                        global const uint* column,
                                                                        global const real* fixed,
                                                                        global accum* partial) {
  local real scratch[SCRATCH10];
  accums s[10];
  for (int k = 0; k < 10; ++k) s[k] = (accums)ACCUM_ZERO;
  const int end = block_end(p.block, p.n);
  for (int i = block_begin(p.block); i < end; i += KREISEL_RUN * GROUP) {
    reals run[10];
    for (int k = 0; k < 10; ++k) run[k] = 0;
    for (int j = i; j < min(i + KREISEL_RUN * GROUP, end); j += GROUP)
      add_rays(run, columns_at(&p, LOAD(j, column)), segments_at(&p, x, fixed, j));
    accum_add10(s, run);
  }
  reduce10(s, scratch, partial);
}

// (ds/dx)^T w for each of p.rows rows of along_ray's w: out[r*VARS*p.n + j], j < VARS*n.
kernel void ray_pull_back(RayParams p, global const real* x, global const uint* column, global const real* w,
                          global real* out) {
  const int i = get_global_id(0) * LANES;
  if (i >= p.n) return;
  const Columns c = columns_at(&p, LOAD(i, column));
  reals z[VARS];
  load_ends(z, i, x);
  for (int end = 0; end < VARS; ++end) z[end] *= p.unit;
  for (int r = 0; r < p.rows; ++r) {
    reals a[3], derivative[VARS];
    along_ray(c, w + 10 * r, a);
    for (int end = 0; end < VARS; ++end)
      derivative[end] = SIGN(end) * (a[0] + z[end] * (a[1] + z[end] * a[2]));
    store_ends(derivative, i, out + (size_t)r * VARS * p.n);
  }
}

// Diagonal of the second derivatives, which have no other entries, of one row of along_ray's w: out[j], j < VARS*n.
kernel void ray_curvature(RayParams p, global const real* x, global const uint* column, global const real* w,
                          global real* out) {
  const int i = get_global_id(0) * LANES;
  if (i >= p.n) return;
  reals a[3], z[VARS];
  along_ray(columns_at(&p, LOAD(i, column)), w, a);
  load_ends(z, i, x);
  for (int end = 0; end < VARS; ++end) z[end] = SIGN(end) * p.unit * (a[1] + 2 * p.unit * a[2] * z[end]);
  store_ends(z, i, out);
}
