/* mesh_moments_gradient_params.h - a triangle mesh as its vertices see it, and a quadric. */
#ifndef KREISEL_MESH_MOMENTS_GRADIENT_PARAMS_H
#define KREISEL_MESH_MOMENTS_GRADIENT_PARAMS_H
#include "params.h"
PARAMS_BEGIN(MeshGradientParams)
  real q[10]; /* coefficients of 1 x y z xy yz xz xx yy zz */
  int n;      /* vertices */
  int pad_;
PARAMS_END(MeshGradientParams)
#endif
