/* reduce10.h - joins a work-group's ten sums (or SUMS) into one partial row.
 *
 * Every item holds SUMS accumulators of LANES sums; after one barrier, items 0..SUMS-1 (as far as there are) each
 * join the GROUP sums of one of them in a fixed order. No atomics and no scheduling in the result: it depends on
 * (n, block, WG, LANES) alone.
 * local  scratch  real  [SCRATCH10]
 * out    partial  accum [groups*SUMS]
 * build  SUMS     10 unless defined before this file is included
 */
#ifndef KREISEL_REDUCE10_H
#define KREISEL_REDUCE10_H
#include "real.h"

#ifndef SUMS
#define SUMS 10
#endif

/* The elements of this item: block_begin .. + LANES, again GROUP further, and so on before block_end. A group's
 * elements lie together, so that neighbours share cache lines on a CPU and coalesce on a GPU. n: padded. */
static inline int block_begin(int block) { return (int)get_group_id(0) * block + (int)get_local_id(0) * LANES; }
static inline int block_end(int block, int n) { return min(((int)get_group_id(0) + 1) * block, n); }

/* Ten sums, each with a run's sum added. */
static inline void accum_add10(accums* s, const reals* run) {
  for (int k = 0; k < 10; ++k) s[k] = accum_add(s[k], run[k]);
}

#ifdef KREISEL_SINGLE
#define SCRATCH10 (2 * SUMS * GROUP)
static inline void accum_store(accums a, int i, local real* scratch) {
  STORE(a.sum, i, scratch);
  STORE(a.err, i, scratch + SUMS * GROUP);
}
static inline accum accum_load(int i, local const real* scratch) {
  const accum a = {scratch[i], scratch[SUMS * GROUP + i]};
  return a;
}
#else
#define SCRATCH10 (SUMS * GROUP)
static inline void accum_store(accums a, int i, local real* scratch) { STORE(a, i, scratch); }
static inline accum accum_load(int i, local const real* scratch) { return scratch[i]; }
#endif

static inline void reduce10(const accums* mine, local real* scratch, global accum* partial) {
  const int lid = get_local_id(0);
  for (int k = 0; k < SUMS; ++k) accum_store(mine[k], k * GROUP + lid * LANES, scratch);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int k = lid; k < SUMS; k += WG) {
    /* Four chains at once: one alone would wait for each addition. */
    accum s0 = ACCUM_ZERO, s1 = ACCUM_ZERO, s2 = ACCUM_ZERO, s3 = ACCUM_ZERO;
    for (int i = k * GROUP; i < (k + 1) * GROUP; i += 4) {
      s0 = accum_join(s0, accum_load(i, scratch));
      s1 = accum_join(s1, accum_load(i + 1, scratch));
      s2 = accum_join(s2, accum_load(i + 2, scratch));
      s3 = accum_join(s3, accum_load(i + 3, scratch));
    }
    partial[get_group_id(0) * SUMS + k] = accum_join(accum_join(s0, s1), accum_join(s2, s3));
  }
}

#endif
