/* real.h - the scalar of a kernel and its accumulator.
 *
 * build  -DKREISEL_SINGLE   float with compensated (two-sum) accumulation, for devices without fp64
 *        otherwise          double, plain accumulation
 *
 * A sum of n terms is within  2u + n^2 u^2  (single, u = 2^-24) or  n u  (double, u = 2^-53) of the sum of
 * absolute values [Ogita, Rump, Oishi 2005, Accurate sum and dot product, proposition 4.5].
 */
#ifndef KREISEL_REAL_H
#define KREISEL_REAL_H

#ifdef KREISEL_SINGLE
#pragma OPENCL FP_CONTRACT OFF
typedef float real;
typedef struct { float sum, err; } accum;
#define ACCUM_ZERO ((accum){0.0f, 0.0f})
static inline accum accum_add(accum a, real v) {
  const float t = a.sum + v;
  const float z = t - a.sum;
  a.err += (a.sum - (t - z)) + (v - z);
  a.sum = t;
  return a;
}
static inline accum accum_join(accum a, accum b) {
  a = accum_add(a, b.sum);
  a.err += b.err;
  return a;
}
#else
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double accum;
#define ACCUM_ZERO 0.0
static inline accum accum_add(accum a, real v) { return a + v; }
static inline accum accum_join(accum a, accum b) { return a + b; }
#endif

#ifndef WG
#define WG 64 /* work-items per group; a default, so that every file compiles alone */
#endif

#endif
