/* SPDX-License-Identifier: MIT */
/* Gauss-Legendre quadrature on [0, 1]: integral of f = sum_i weight[i] f(node[i]), exact for degree 2 n - 1. */
#ifndef FS_MATH_QUADRATURE_H
#define FS_MATH_QUADRATURE_H

#include "base/base.h"

enum { FS_GAUSS_MAX_NODES = 64 };

/* node[n], ascending, and weight[n] of n = 1 .. 64 nodes; FS_ERR_ARGUMENT otherwise. */
fs_status fs_gauss_legendre(fs_context *ctx, int32_t n, double *node, double *weight);

#endif
