// mesh_moments_gradient.cl - the derivative of q . s, the integral of a quadric over the solid inside a closed mesh, in
// every vertex of the mesh.
//
// A vertex moves each triangle beside it by its hat function, so the derivative is the sum over those triangles of the
// integral of q times that function, along the normal. Over a triangle with corners a, b, c, q is a quadratic with the
// values qa, qb, qc and the side terms ab, bc, ca (4 times its value in the middle of the side, less those at the ends);
// the mean of q times the hat of a is  qa / 10 + (qb + qc + ab + ca) / 30 + bc / 60.
//
// in    vertex    real  [4*n]          x y z 0, relative to a centre chosen by the host, and q is of these
// in    first     uint  [n+1]          where the triangles beside a vertex begin in `others`
// in    others    uint  [2*first[n]]   b and c of each, with which the vertex itself is an outward triangle
// out   gradient  real  [4*n]          x y z 0
// build KREISEL_SINGLE                 see real.h
// sum   every vertex gathers its own triangles in their order: no atomics, and nothing depends on scheduling

#include "mesh_moments_gradient_params.h"

typedef JOINED(REAL, 4) real4;

static inline real quadric(const MeshGradientParams* p, real4 v) {
  return p->q[0] + (p->q[1] + p->q[7] * v.x + p->q[4] * v.y + p->q[6] * v.z) * v.x +
         (p->q[2] + p->q[8] * v.y + p->q[5] * v.z) * v.y + (p->q[3] + p->q[9] * v.z) * v.z;
}

kernel void mesh_moments_gradient(MeshGradientParams p, global const real* vertex, global const uint* first,
                                  global const uint* others, global real* gradient) {
  const int i = get_global_id(0);
  if (i >= p.n) return;
  const real4 a = vload4(i, vertex);
  const real qa = quadric(&p, a);
  real4 sum = (real4)(0);
  for (uint k = first[i]; k < first[i + 1]; ++k) {
    const real4 b = vload4(others[2 * k], vertex), c = vload4(others[2 * k + 1], vertex);
    const real qb = quadric(&p, b), qc = quadric(&p, c);
    const real ab = 4 * quadric(&p, (a + b) / 2) - qa - qb, bc = 4 * quadric(&p, (b + c) / 2) - qb - qc,
               ca = 4 * quadric(&p, (c + a) / 2) - qc - qa;
    const real mean = qa / 10 + (qb + qc + ab + ca) / 30 + bc / 60;
    sum += mean / 2 * cross(b - a, c - a);
  }
  vstore4(sum, i, gradient);
}
