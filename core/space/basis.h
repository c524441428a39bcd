/* SPDX-License-Identifier: MIT */
/* The basis functions of an extraction and their derivatives at quadrature points: filled once, used by all elements of
   that extraction. */
#ifndef FS_SPACE_BASIS_H
#define FS_SPACE_BASIS_H

#include "space/space.h"

enum { FS_POINT_BLOCK = 8, FS_N_DERIVATIVES = 9 };

/* Derivatives of order 1 to 3 by (u, v): derivative d is FS_DU + d of the enumeration in space.h. Points are numbered u fastest
   and padded to whole blocks with weight 0; dofs to a multiple of 8 with functions that vanish.

   Where the extraction has a chart, inverse is the matrix that turns derivatives by (u, v) into those by the coordinates of the
   chart, and chart_weight the weight times |det d'|. Where it is a tensor product of cubics, axis holds the functions of one axis,
   for contractions axis by axis. */
typedef struct fs_basis_table {
  int32_t n_nodes, n_blocks, n_dofs, n_padded;
  double *weight;       /* [n_blocks][8] */
  double *by_dof;       /* [n_blocks][9][n_dofs][8]: points innermost */
  double *by_point;     /* [n_blocks][8][9][n_padded]: dofs innermost; NULL where axis is there */
  double *chart_weight; /* [n_blocks][8] or NULL */
  double *inverse;      /* [n_blocks][9][9][8] or NULL */
  double *axis;         /* [n_nodes][4][4] or NULL: d^o N_i at a node, as [node][o][i] */
} fs_basis_table;

/* n_nodes x n_nodes Gauss-Legendre points. */
fs_status fs_basis_create(fs_context *ctx, const fs_extraction *extraction, int32_t n_nodes, fs_basis_table **table);
void fs_basis_free(fs_context *ctx, fs_basis_table *table); /* NULL is allowed */

#endif
