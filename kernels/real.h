/* real.h - the scalar of a kernel, the vector an item works on, and the accumulator.
 *
 * build  -DKREISEL_SINGLE   float with compensated (two-sum) accumulation, for devices without fp64
 *        otherwise          double, plain accumulation
 *        -DLANES=n          neighbouring elements that an item works on at once, as one vector: 1, 4, 8 or 16
 *        -DWG=n             work-items of a summing group
 * A CPU has long vectors and walks memory in order: LANES = its width, WG = 1. On a GPU neighbouring items are the
 * lanes: LANES = 1, WG = 64.
 *
 * Terms are added up plainly in runs of KREISEL_RUN (params.h), and the runs' sums to an accumulator. A chain of n
 * additions is within  (KREISEL_RUN + 1) u + n^2 u^2  (single, u = 2^-24) or  n u  (double, u = 2^-53) of the sum of
 * absolute values: KREISEL_RUN - 1 roundings in a run, and 2u + n^2 u^2 of the accumulator [Ogita, Rump, Oishi 2005,
 * Accurate sum and dot product, proposition 4.5].
 */
#ifndef KREISEL_REAL_H
#define KREISEL_REAL_H

#ifndef LANES
#define LANES 1 /* defaults, so that every file compiles alone */
#define WG 64
#endif
#define GROUP (WG * LANES) /* elements a work-group takes at once; a multiple of 4 */

#ifdef KREISEL_SINGLE
#define REAL float
#else
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define REAL double
#endif
typedef REAL real;
#define JOINED_(a, b) a##b
#define JOINED(a, b) JOINED_(a, b)

/* reals, words: LANES elements. Arrays are padded to whole groups, so LOAD and STORE need no test at the end. */
#if LANES == 1
typedef real reals;
typedef uint words;
#define LOAD(i, p) (p)[i]
#define STORE(v, i, p) (p)[i] = (v)
#define TO_REALS(w) (real)(w)
/* Pairs lie interleaved: first and second of element i at 2 i and 2 i + 1. */
#define LOAD_PAIRS(a, b, i, p) ((a) = (p)[2 * (i)], (b) = (p)[2 * (i) + 1])
#define STORE_PAIRS(a, b, i, p) ((p)[2 * (i)] = (a), (p)[2 * (i) + 1] = (b))
#else
typedef JOINED(REAL, LANES) reals;
typedef JOINED(uint, LANES) words;
#define LOAD(i, p) JOINED(vload, LANES)(0, (p) + (i))
#define STORE(v, i, p) JOINED(vstore, LANES)(v, 0, (p) + (i))
#define TO_REALS(w) JOINED(convert_, JOINED(REAL, LANES))(w)
#define LOAD_PAIRS(a, b, i, p) load_pairs(&(a), &(b), (p) + 2 * (i))
#define STORE_PAIRS(a, b, i, p) store_pairs(a, b, (p) + 2 * (i))
static inline void load_pairs(reals* a, reals* b, global const real* p) {
  const reals u = LOAD(0, p), v = LOAD(LANES, p);
  *a = (reals)(u.even, v.even);
  *b = (reals)(u.odd, v.odd);
}
static inline void store_pairs(reals a, reals b, global real* p) {
  reals u, v;
  u.even = a.lo, u.odd = b.lo;
  v.even = a.hi, v.odd = b.hi;
  STORE(u, 0, p);
  STORE(v, LANES, p);
}
#endif

/* accum: one sum, as it leaves the device. accums: LANES sums at once. */
#ifdef KREISEL_SINGLE
typedef struct { real sum, err; } accum;
typedef struct { reals sum, err; } accums;
#define ACCUM_ZERO {0, 0}
static inline accums accum_add(accums a, reals v) {
#pragma OPENCL FP_CONTRACT OFF
  const reals t = a.sum + v;
  const reals z = t - a.sum;
  a.err += (a.sum - (t - z)) + (v - z);
  a.sum = t;
  return a;
}
static inline accum accum_join(accum a, accum b) {
#pragma OPENCL FP_CONTRACT OFF
  const real t = a.sum + b.sum;
  const real z = t - a.sum;
  a.err += ((a.sum - (t - z)) + (b.sum - z)) + b.err;
  a.sum = t;
  return a;
}
#else
typedef real accum;
typedef reals accums;
#define ACCUM_ZERO 0
static inline accums accum_add(accums a, reals v) { return a + v; }
static inline accum accum_join(accum a, accum b) { return a + b; }
#endif

#endif
