/* quadric_moments_params.h - a bundle of vertical intervals and the quadric that clips them. */
#ifndef KREISEL_QUADRIC_MOMENTS_PARAMS_H
#define KREISEL_QUADRIC_MOMENTS_PARAMS_H
#include "params.h"
PARAMS_BEGIN(QuadricParams)
  real ox, oy;    /* centre of column (0,0), body units */
  real h;         /* spacing: an interval stands for an h x h column */
  real q[10];     /* coefficients of 1 x y z xy yz xz xx yy zz, the first with (q[7] + q[8]) h^2/12 added: q at the
                     centre of a column is its mean over the cross-section */
  real inverse_a; /* 1 / q[9]; infinity, not minus infinity, for 0 */
  int n;          /* intervals, padded */
  int block;      /* intervals a work-group sums */
PARAMS_END(QuadricParams)
#endif
