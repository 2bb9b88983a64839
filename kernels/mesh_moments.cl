// mesh_moments.cl - exact ten moments of the solid inside a closed triangle mesh, by the divergence theorem:
// each triangle stands for the signed tetrahedron to the origin, over which the ten integrals are polynomials
// of its corners. [SpinIt, eq. 4; RayRep, s. 3.4]
//
// in    vertex    real4 [vertices]   relative to a centre chosen by the host, to keep cancellation small; w unused
// in    corner    uint  [3*n]        first, second, third corner of every triangle; the padding's lie at the centre
// out   partial   accum [groups*10]    one row a work-group, order s1 sx sy sz sxy syz sxz sxx syy szz
// build WG, LANES, KREISEL_SINGLE    see real.h; n is a multiple of GROUP
// sum   a block of elements a group, reduce10 at its end: fixed order, no atomics
#include "mesh_moments_params.h"
#include "reduce10.h"

// Integral of u v over a tetrahedron of volume V with corners 0, a, b, c:
// V/20 * ((sum u)(sum v) + sum u v), sums over the corners.
static inline reals product(reals ua, reals ub, reals uc, reals va, reals vb, reals vc) {
  return (ua + ub + uc) * (va + vb + vc) + ua * va + ub * vb + uc * vc;
}

typedef JOINED(REAL, 4) real4;
typedef struct { reals x, y, z; } Points;

/* A vertex is loaded whole and four are transposed, which costs a third of gathering each coordinate. */
#if LANES == 1
static inline Points points_at(global const real4* vertex, uint i) {
  const real4 a = vertex[i];
  const Points p = {a.x, a.y, a.z};
  return p;
}
#else
typedef struct { real4 x, y, z; } Points4;
static inline Points4 points4(global const real4* vertex, uint4 i) {
  const real4 a = vertex[i.x], b = vertex[i.y], c = vertex[i.z], d = vertex[i.w];
  const Points4 p = {(real4)(a.x, b.x, c.x, d.x), (real4)(a.y, b.y, c.y, d.y), (real4)(a.z, b.z, c.z, d.z)};
  return p;
}
static inline Points points_at(global const real4* vertex, words i) {
#if LANES == 4
  const Points4 a = points4(vertex, i);
  const Points p = {a.x, a.y, a.z};
#elif LANES == 8
  const Points4 a = points4(vertex, i.lo), b = points4(vertex, i.hi);
  const Points p = {(reals)(a.x, b.x), (reals)(a.y, b.y), (reals)(a.z, b.z)};
#else
  const Points4 a = points4(vertex, i.lo.lo), b = points4(vertex, i.lo.hi), c = points4(vertex, i.hi.lo),
                d = points4(vertex, i.hi.hi);
  const Points p = {(reals)(a.x, b.x, c.x, d.x), (reals)(a.y, b.y, c.y, d.y), (reals)(a.z, b.z, c.z, d.z)};
#endif
  return p;
}
#endif

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void mesh_moments(MeshParams p,
                                                                         global const real4* vertex,
                                                                         global const uint* corner,
                                                                         global accum* partial) {
  local real scratch[SCRATCH10];
  accums s[10];
  for (int k = 0; k < 10; ++k) s[k] = (accums)ACCUM_ZERO;
  const real sixth = (real)1 / 6, fourth = (real)1 / 4, twentieth = (real)1 / 20;
  for (int i = block_begin(p.block); i < block_end(p.block, p.n); i += GROUP) {
    const Points a = points_at(vertex, LOAD(i, corner)), b = points_at(vertex, LOAD(i, corner + p.n)),
                 c = points_at(vertex, LOAD(i, corner + 2 * (size_t)p.n));
    const reals v = sixth * (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                             a.z * (b.x * c.y - b.y * c.x));
    const reals first = fourth * v, second = twentieth * v;
    s[0] = accum_add(s[0], v);
    s[1] = accum_add(s[1], first * (a.x + b.x + c.x));
    s[2] = accum_add(s[2], first * (a.y + b.y + c.y));
    s[3] = accum_add(s[3], first * (a.z + b.z + c.z));
    s[4] = accum_add(s[4], second * product(a.x, b.x, c.x, a.y, b.y, c.y));
    s[5] = accum_add(s[5], second * product(a.y, b.y, c.y, a.z, b.z, c.z));
    s[6] = accum_add(s[6], second * product(a.x, b.x, c.x, a.z, b.z, c.z));
    s[7] = accum_add(s[7], second * product(a.x, b.x, c.x, a.x, b.x, c.x));
    s[8] = accum_add(s[8], second * product(a.y, b.y, c.y, a.y, b.y, c.y));
    s[9] = accum_add(s[9], second * product(a.z, b.z, c.z, a.z, b.z, c.z));
  }
  reduce10(s, scratch, partial);
}
