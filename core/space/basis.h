/* SPDX-License-Identifier: MIT */
/* The basis functions of an extraction and their derivatives at quadrature points: filled once, used by all elements of
   that extraction. */
#ifndef FS_SPACE_BASIS_H
#define FS_SPACE_BASIS_H

#include "space/space.h"

enum { FS_POINT_BLOCK = 8, FS_N_DERIVATIVES = 9 };

/* Derivatives of order 1 to 3 by one pair of coordinates: derivative d is FS_DU + d of the enumeration in space.h. The points
   are padded to whole blocks with weight 0; dofs to a multiple of 8 with functions that vanish. */
typedef struct fs_basis_jets {
  double *weight;   /* [n_blocks][8] */
  double *by_dof;   /* [n_blocks][9][n_dofs][8]: points innermost */
  double *by_point; /* [n_blocks][8][9][n_padded]: dofs innermost */
} fs_basis_jets;

typedef struct fs_basis_table {
  int32_t n_blocks, n_dofs, n_padded;
  fs_basis_jets parameter; /* by (u, v), weights of the unit square */
  fs_basis_jets chart;     /* by the coordinates of the chart, weights times |det d'|; NULLs: the same as parameter */
} fs_basis_table;

/* n_nodes x n_nodes Gauss-Legendre points. */
fs_status fs_basis_create(fs_context *ctx, const fs_extraction *extraction, int32_t n_nodes, fs_basis_table **table);
void fs_basis_free(fs_context *ctx, fs_basis_table *table); /* NULL is allowed */

#endif
