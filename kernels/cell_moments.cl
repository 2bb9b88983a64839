// cell_moments.cl - what of the interior lies in each cell of an octree: ten sums over its voxels, exactly.
// [SpinIt, s. 5.3]
//
// in    cube   ushort4 [n]      corner ix, iy, iz and edge, in voxels; edges at most 256
// in    first  uint  [nx*ny+1]  of each column ix + nx iy, its first run; then the number of runs
// in    ix     uint  [runs]     the column's ix again
// in    low    uint  [runs]     a run of interior voxels: low <= iz < high; columns in order, runs upwards
// in    high   uint  [runs]
// out   sums   ulong [10*n]     by cube: sums of 1, i, j, k, ij, jk, ik, ii, jj, kk over the interior voxels in it, where
//                               (i, j, k) is a voxel's place in the cube, from 0: order s1 sx sy sz sxy syz sxz sxx syy szz
// build LANES                   1: a GPU, one run at once; else eight runs at once, a CPU's vector of words
// sum   of whole numbers: no rounding, in any precision and any order. A row of a cube fits 32 bits: of 256^2 voxels
//       each sum of products is below 256^4 / 3. A cube's fits 64
#include "cell_moments_params.h"

#if LANES == 1
typedef uint runs;
#define RUNS 1
#define LOAD_RUNS(i, p) (p)[i]
#define KEEP(i, end, x) (x)
#define TOTAL(x) (x)
#else
typedef uint8 runs;
#define RUNS 8
#define LOAD_RUNS(i, p) vload8(0, (p) + (i))
#define KEEP(i, end, x) ((x) & as_uint8((uint8)(i) + (uint8)(0, 1, 2, 3, 4, 5, 6, 7) < (uint8)(end)))
static inline uint TOTAL(uint8 v) {
  const uint4 a = v.lo + v.hi;
  const uint2 b = a.lo + a.hi;
  return b.lo + b.hi;
}
#endif

// A run's ends in the cube, from 0: below the cube both are 0, above it both e.
#define CLIP(r, ends) (min(max(LOAD_RUNS(r, ends), (runs)z0) - z0, (runs)e))

kernel void cell_moments(CellParams p, global const ushort4* cube, global const uint* first, global const uint* ix,
                         global const uint* low, global const uint* high, global ulong* sums) {
  const int c = get_global_id(0);
  if (c >= p.n) return;
  const uint x0 = cube[c].x, y0 = cube[c].y, z0 = cube[c].z, e = cube[c].w;
  // A cube may lie beyond the grid's end in part, or as a whole.
  const uint left = min(x0, (uint)p.nx), x1 = min(x0 + e, (uint)p.nx), y1 = min(y0 + e, (uint)p.ny);
  ulong s[10];
  for (int k = 0; k < 10; ++k) s[k] = 0;
  ulong whole = 0, whole_j = 0, whole_jj = 0;  // rows without shell, and sums of their j, j^2
  for (uint y = y0; y < y1; ++y) {
    const uint begin = first[y * p.nx + left], end = first[y * p.nx + x1];
    runs n = 0;
    for (uint r = begin; r < end; r += RUNS) n += KEEP(r, end, CLIP(r, high) - CLIP(r, low));
    const ulong j = y - y0, row = TOTAL(n);
    if (row == 0) continue;
    if (row == e * e) {  // most rows of most cubes
      ++whole;
      whole_j += j;
      whole_jj += j * j;
      continue;
    }
    runs in = 0, iin = 0, kn = 0, ikn = 0, kkn = 0;
    for (uint r = begin; r < end; r += RUNS) {
      const runs a = CLIP(r, low), b = CLIP(r, high), count = KEEP(r, end, b - a), i = LOAD_RUNS(r, ix) - x0;
      // Of k and k^2 over a <= k < b. (a + b - 1) count is even; 2 (a^2 + ab + b^2) - 3 (a + b) + 1 times count is
      // six times the second.
      const runs sum = a + b, k = (sum - 1) * count / 2;
      in += i * count;
      iin += i * i * count;
      kn += k;
      ikn += i * k;
      kkn += count * (2 * (sum * sum - a * b) - 3 * sum + 1) / 6;
    }
    const ulong along_x = TOTAL(in), along_z = TOTAL(kn);
    s[0] += row;
    s[1] += along_x;
    s[2] += j * row;
    s[3] += along_z;
    s[4] += j * along_x;
    s[5] += j * along_z;
    s[6] += TOTAL(ikn);
    s[7] += TOTAL(iin);
    s[8] += j * j * row;
    s[9] += TOTAL(kkn);
  }
  const ulong ee = e * e, one = e * (e - 1) / 2, two = one * (2 * e - 1) / 3;  // sums of 1, i, i^2 along a row: e, one, two
  s[0] += whole * ee;
  s[1] += whole * e * one;
  s[2] += whole_j * ee;
  s[3] += whole * e * one;
  s[4] += whole_j * e * one;
  s[5] += whole_j * e * one;
  s[6] += whole * one * one;
  s[7] += whole * e * two;
  s[8] += whole_jj * ee;
  s[9] += whole * e * two;
  for (int k = 0; k < 10; ++k) sums[10 * (size_t)c + k] = s[k];
}
