/* cell_moments_params.h - cubes of a grid's cells, and the interior as runs along z. */
#ifndef KREISEL_CELL_MOMENTS_PARAMS_H
#define KREISEL_CELL_MOMENTS_PARAMS_H
#include "params.h"
PARAMS_BEGIN(CellParams)
  int nx, ny; /* columns of the grid */
  int n;      /* cubes */
  int pad_;
PARAMS_END(CellParams)
#endif
