// voxel_moments.cl - ten moments of a voxel fill at unit density, and their derivatives. [SpinIt, eq. 4]
//
// in    fill     real  [n]         in [0,1]; 0 empty, 1 solid; 0 in the padding
// in    cell     uint  [n]         ix | iy << 10 | iz << 20: at most 1024 cells along an axis
// out   partial  accum [groups*10] one row a work-group, order s1 sx sy sz sxy syz sxz sxx syy szz
// build WG, LANES, KREISEL_SINGLE  see real.h; arrays are padded to a multiple of GROUP, p.n counts the padding
// sum   a block of elements a group, reduce10 at its end: fixed order, no atomics
// cells are boxes: each diagonal second moment carries h^2/12 of its cell
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

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void voxel_moments(VoxelParams p,
                                                                          global const real* fill,
                                                                          global const uint* cell,
                                                                          global accum* partial) {
  local real scratch[SCRATCH10];
  accums s[10];
  for (int k = 0; k < 10; ++k) s[k] = (accums)ACCUM_ZERO;
  const real volume = p.h * p.h * p.h, hh = p.h * p.h / 12;
  for (int i = block_begin(p.block); i < block_end(p.block, p.n); i += GROUP) {
    const Centres c = centres_of(&p, LOAD(i, cell));
    const reals v = volume * LOAD(i, fill);
    s[0] = accum_add(s[0], v);
    s[1] = accum_add(s[1], v * c.x);
    s[2] = accum_add(s[2], v * c.y);
    s[3] = accum_add(s[3], v * c.z);
    s[4] = accum_add(s[4], v * c.x * c.y);
    s[5] = accum_add(s[5], v * c.y * c.z);
    s[6] = accum_add(s[6], v * c.x * c.z);
    s[7] = accum_add(s[7], v * (c.x * c.x + hh));
    s[8] = accum_add(s[8], v * (c.y * c.y + hh));
    s[9] = accum_add(s[9], v * (c.z * c.z + hh));
  }
  reduce10(s, scratch, partial);
}

// (ds/dfill)^T w for each of p.rows weight rows; s is linear in the fill, so this needs no fill:
// out[r*n + i] = sum_k w[r*10+k] ds_k/dfill_i.
kernel void voxel_pull_back(VoxelParams p, global const uint* cell, global const real* w, global real* out) {
  const int i = get_global_id(0) * LANES;
  if (i >= p.n) return;
  const Centres c = centres_of(&p, LOAD(i, cell));
  const real volume = p.h * p.h * p.h, hh = p.h * p.h / 12;
  for (int r = 0; r < p.rows; ++r) {
    global const real* a = w + 10 * r;
    const reals derivative =
        volume * (a[0] + a[1] * c.x + a[2] * c.y + a[3] * c.z + a[4] * c.x * c.y + a[5] * c.y * c.z +
                  a[6] * c.x * c.z + a[7] * (c.x * c.x + hh) + a[8] * (c.y * c.y + hh) + a[9] * (c.z * c.z + hh));
    STORE(derivative, i, out + (size_t)r * p.n);
  }
}
