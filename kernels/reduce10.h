/* reduce10.h - joins a work-group's ten sums into one partial row.
 *
 * Every item holds ten accumulators; after one barrier, items 0..9 each join one moment over the group in a
 * fixed order. No atomics and no scheduling in the result: it depends on (n, WG, block) alone.
 * local  scratch  accum [10*WG]
 * out    partial  accum [groups*10]
 */
#ifndef KREISEL_REDUCE10_H
#define KREISEL_REDUCE10_H
#include "real.h"

/* The elements of this item: block_begin, + WG, + WG ... before block_end. A group's elements lie together, so
 * that neighbours share cache lines on a CPU and coalesce on a GPU. */
static inline int block_begin(int block) { return (int)get_group_id(0) * block + (int)get_local_id(0); }
static inline int block_end(int block, int n) { return min(((int)get_group_id(0) + 1) * block, n); }

static inline void reduce10(const accum* mine, local accum* scratch, global accum* partial) {
  const int lid = get_local_id(0);
  for (int k = 0; k < 10; ++k) scratch[k * WG + lid] = mine[k];
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int k = lid; k < 10; k += WG) {
    accum sum = ACCUM_ZERO;
    for (int i = 0; i < WG; ++i) sum = accum_join(sum, scratch[k * WG + i]);
    partial[get_group_id(0) * 10 + k] = sum;
  }
}

#endif
