/* mesh_moments_params.h - a closed, outward-oriented triangle mesh. */
#ifndef KREISEL_MESH_MOMENTS_PARAMS_H
#define KREISEL_MESH_MOMENTS_PARAMS_H
#include "params.h"
PARAMS_BEGIN(MeshParams)
  int n;     /* triangles, padded */
  int block; /* triangles a work-group sums */
PARAMS_END(MeshParams)
#endif
