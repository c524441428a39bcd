/* SPDX-License-Identifier: MIT */
/* Fewer unknowns: the free dofs of a problem as an affine function of others, x = x0 + T y, T sparse. What is minimised over
   y has the gradient T^T g and the Hessian T^T H T. */
#ifndef FS_FAIR_REDUCE_H
#define FS_FAIR_REDUCE_H

#include "solve/sparse.h"

/* Rows are the free dofs, columns the new unknowns, both in groups of three numbers. Either block or weight is NULL: entries
   are 3x3 matrices, or numbers that stand for multiples of the unit matrix. */
typedef struct fs_reduction {
  int32_t n_rows, n_columns;
  int32_t *row_start;                /* [n_rows + 1] */
  int32_t *column;                   /* [row_start[n_rows]] */
  double *block;                     /* [row_start[n_rows]][9], row-major */
  double *weight;                    /* [row_start[n_rows]] */
  double *x0;                        /* [3 n_rows] */
  struct fs_coarse_squares *squares; /* of displacements of a coarser mesh; or NULL */
  bool *is_idle; /* [3 n_columns] numbers of y that nothing depends on, there to fill a group; NULL: none */
} fs_reduction;

void fs_reduction_free(fs_context *ctx, fs_reduction *reduction); /* NULL is allowed */

/* x[3 n_rows] = x0 + T y */
void fs_reduction_apply(const fs_reduction *reduction, const double *y, double *x);

/* y[3 n_columns] = T^T x */
void fs_reduction_gather(const fs_reduction *reduction, const double *x, double *y);

/* The pattern of T^T H T where H has the pattern that fs_sparse_create makes of the same sets. */
fs_status fs_reduction_pattern(fs_context *ctx, const fs_reduction *reduction, int32_t n_sets, const int64_t *set_start,
                               const int32_t *member, fs_sparse **pattern);

/* reduced = T^T H T; the diagonal of idle numbers is the mean of the others of their group, so that it stays definite. */
fs_status fs_reduction_hessian(fs_context *ctx, const fs_reduction *reduction, const fs_sparse *hessian,
                               fs_sparse *reduced);

#endif
