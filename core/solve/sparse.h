/* SPDX-License-Identifier: MIT */
/* Symmetric sparse matrices of 3x3 blocks, lower triangle by columns: pattern once, values many times.

   Block column J holds the block rows row[col_start[J]] .. row[col_start[J + 1] - 1], ascending, the diagonal first. With
   n = col_start[J + 1] - col_start[J] of them, scalar column 3 J + c lies at value[9 col_start[J] + 3 n c], three numbers per
   block row. The three numbers above the diagonal of a diagonal block are kept but mean nothing to a solver. */
#ifndef FS_SOLVE_SPARSE_H
#define FS_SOLVE_SPARSE_H

#include "base/base.h"

typedef struct fs_sparse {
  int32_t n_blocks;   /* block rows */
  int32_t *col_start; /* [n_blocks + 1] */
  int32_t *row;       /* [col_start[n_blocks]] */
  double *value;      /* [9 col_start[n_blocks]] */
} fs_sparse;

/* The pattern in which all members of a set are coupled with each other: set s has the members
   member[set_start[s]] .. member[set_start[s + 1] - 1], block rows or FS_NONE (skipped). Every diagonal block is there.
   FS_ERR_UNSUPPORTED when the blocks would leave int32_t. Values are zero. */
fs_status fs_sparse_create(fs_context *ctx, int32_t n_blocks, int32_t n_sets, const int64_t *set_start,
                           const int32_t *member, fs_sparse **sparse);
void fs_sparse_free(fs_context *ctx, fs_sparse *sparse); /* NULL is allowed */

void fs_sparse_clear(fs_sparse *sparse);

/* Adds block[9] (row-major: row component first) at block row i, block column j; i >= j, and in the pattern. */
void fs_sparse_add(fs_sparse *sparse, int32_t i, int32_t j, const double *block);

/* trace[n_blocks] = mean of the three diagonal entries of every diagonal block. */
void fs_sparse_diagonal(const fs_sparse *sparse, double *mean);

/* y = A x, for tests. */
void fs_sparse_multiply(const fs_sparse *sparse, const double *x, double *y);

#endif
