// voxel_moments.cl - ten moments of a voxel fill, and their derivatives. [SpinIt, eq. 4]
//
// in    fill     real  [n]         in [0,1]; 0 empty, 1 solid; 0 in the padding
// in    cell     uint  [n]         ix | iy << 10 | iz << 20: at most 1024 cells along an axis
// out   partial  accum [groups*10] one row a work-group, order s1 sx sy sz sxy syz sxz sxx syy szz,
//                                  of unit masses at the centres: the host makes them boxes
// build WG, LANES, KREISEL_SINGLE  see real.h; arrays are padded to a multiple of GROUP, p.n counts the padding
// sum   a block of elements a group, reduce10 at its end: fixed order, no atomics
#include "reduce10.h"
#include "voxel_moments_params.h"

typedef struct { reals x, y, z; } Centres;

static inline Centres centres_of(const VoxelParams* p, words packed) {
  Centres c;
  c.x = p->ox + p->h * TO_REALS(packed & 1023u);
  c.y = p->oy + p->h * TO_REALS(packed >> 10 & 1023u);
  c.z = p->oz + p->h * TO_REALS(packed >> 20);
  return c;
}

static inline void add_voxels(reals* s, Centres c, reals fill) {
  const reals x = fill * c.x, y = fill * c.y, z = fill * c.z;
  s[0] += fill;
  s[1] += x;
  s[2] += y;
  s[3] += z;
  s[4] += x * c.y;
  s[5] += y * c.z;
  s[6] += x * c.z;
  s[7] += x * c.x;
  s[8] += y * c.y;
  s[9] += z * c.z;
}

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void voxel_moments(VoxelParams p,
                                                                          global const real* fill,
                                                                          global const uint* cell,
                                                                          global accum* partial) {
  local real scratch[SCRATCH10];
  accums s[10];
  for (int k = 0; k < 10; ++k) s[k] = (accums)ACCUM_ZERO;
  const int end = block_end(p.block, p.n);
  for (int i = block_begin(p.block); i < end; i += KREISEL_RUN * GROUP) {
    reals run[10];
    for (int k = 0; k < 10; ++k) run[k] = 0;
    for (int j = i; j < min(i + KREISEL_RUN * GROUP, end); j += GROUP)
      add_voxels(run, centres_of(&p, LOAD(j, cell)), LOAD(j, fill));
    accum_add10(s, run);
  }
  reduce10(s, scratch, partial);
}

// (ds/dfill)^T w for each of p.rows weight rows; s is linear in the fill, so this needs no fill. A row a of w holds
// the coefficients of the polynomial that is the derivative at a centre, in the order of the moments:
// out[r*n + i] = a_0 + a_1 x + .. + a_9 z^2.
kernel void voxel_pull_back(VoxelParams p, global const uint* cell, global const real* w, global real* out) {
  const int i = get_global_id(0) * LANES;
  if (i >= p.n) return;
  const Centres c = centres_of(&p, LOAD(i, cell));
  for (int r = 0; r < p.rows; ++r) {
    global const real* a = w + 10 * r;
    const reals x = a[1] + a[4] * c.y + a[6] * c.z + a[7] * c.x, y = a[2] + a[5] * c.z + a[8] * c.y,
                z = a[3] + a[9] * c.z;
    STORE(a[0] + x * c.x + y * c.y + z * c.z, i, out + (size_t)r * p.n);
  }
}
