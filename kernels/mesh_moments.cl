// mesh_moments.cl - exact ten moments of the solid inside a closed triangle mesh, by the divergence theorem:
// each triangle stands for the signed tetrahedron to the origin, over which the ten integrals are polynomials
// of its corners. [SpinIt, eq. 4; RayRep, s. 3.4]
//
// in    vertex    real [3*vertices]  relative to a centre chosen by the host, to keep cancellation small
// in    triangle  uint [3*n]
// out   partial   accum [groups*10]  one row a work-group, order s1 sx sy sz sxy syz sxz sxx syy szz
// build WG, KREISEL_SINGLE           see real.h
// sum   a block of elements a group, reduce10 at its end: fixed order, no atomics
#include "mesh_moments_params.h"
#include "reduce10.h"

// Integral of u v over a tetrahedron of volume V with corners 0, a, b, c:
// V/20 * ((sum u)(sum v) + sum u v), sums over the corners.
static inline real product(real ua, real ub, real uc, real va, real vb, real vc) {
  return (ua + ub + uc) * (va + vb + vc) + ua * va + ub * vb + uc * vc;
}

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void mesh_moments(MeshParams p,
                                                                         global const real* vertex,
                                                                         global const uint* triangle,
                                                                         global accum* partial) {
  local accum scratch[10 * WG];
  accum s[10];
  for (int k = 0; k < 10; ++k) s[k] = ACCUM_ZERO;
  for (int i = block_begin(p.block); i < block_end(p.block, p.n); i += WG) {
    global const real* a = vertex + 3 * (size_t)triangle[3 * i];
    global const real* b = vertex + 3 * (size_t)triangle[3 * i + 1];
    global const real* c = vertex + 3 * (size_t)triangle[3 * i + 2];
    const real ax = a[0], ay = a[1], az = a[2], bx = b[0], by = b[1], bz = b[2], cx = c[0], cy = c[1], cz = c[2];
    const real v = (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6;
    const real first = v / 4, second = v / 20;
    s[0] = accum_add(s[0], v);
    s[1] = accum_add(s[1], first * (ax + bx + cx));
    s[2] = accum_add(s[2], first * (ay + by + cy));
    s[3] = accum_add(s[3], first * (az + bz + cz));
    s[4] = accum_add(s[4], second * product(ax, bx, cx, ay, by, cy));
    s[5] = accum_add(s[5], second * product(ay, by, cy, az, bz, cz));
    s[6] = accum_add(s[6], second * product(ax, bx, cx, az, bz, cz));
    s[7] = accum_add(s[7], second * product(ax, bx, cx, ax, bx, cx));
    s[8] = accum_add(s[8], second * product(ay, by, cy, ay, by, cy));
    s[9] = accum_add(s[9], second * product(az, bz, cz, az, bz, cz));
  }
  reduce10(s, scratch, partial);
}
