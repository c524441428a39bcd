/* SPDX-License-Identifier: MIT */
/* Vectors of points with the derivatives that densities take; kernels.c chooses the instruction set at run time. */
#ifndef FS_FAIR_LANES_H
#define FS_FAIR_LANES_H

#include <fairsurf/fair.h>
#include "math/lanes.h"

/* The nine derivative vectors of a jet, and the number of the block of a pair i <= j of them. */
enum { D_U, D_V, D_UU, D_UV, D_VV, D_UUU, D_UUV, D_UVV, D_VVV, N_DERIVATIVES };
enum { N_PAIRS = N_DERIVATIVES * (N_DERIVATIVES + 1) / 2 };
static inline int pair_of(int i, int j) { return i * N_DERIVATIVES - i * (i - 1) / 2 + j - i; }

#endif
