/* SPDX-License-Identifier: MIT */
/* Single role: an affine map of the unknowns, applied to points, gradients and Hessians:
     x = x0 + T y,   g_y = T^T g,   H_y = T^T H T = sum over blocks (i, j) of H, columns a of row i and b of row j,
                                    of T_ia^T H_ij T_jb. */
#include "fair/reduce.h"

#include <string.h>

void fs_reduction_free(fs_context *ctx, fs_reduction *r) {
  if (r == NULL) return;
  fs_release(ctx, r->row_start);
  fs_release(ctx, r->column);
  fs_release(ctx, r->block);
  fs_release(ctx, r->weight);
  fs_release(ctx, r->x0);
  fs_release(ctx, r->is_idle);
  fs_release(ctx, r);
}

void fs_reduction_apply(const fs_reduction *r, const double *y, double *x) {
  memcpy(x, r->x0, 3 * (size_t)r->n_rows * sizeof *x);
  for (int32_t i = 0; i < r->n_rows; i++, x += 3)
    for (int32_t e = r->row_start[i]; e < r->row_start[i + 1]; e++) {
      const double *from = y + 3 * (size_t)r->column[e];
      if (r->weight != NULL) {
        for (int a = 0; a < 3; a++) x[a] += r->weight[e] * from[a];
      } else {
        const double *block = r->block + 9 * (size_t)e;
        for (int a = 0; a < 3; a++)
          x[a] += block[3 * a] * from[0] + block[3 * a + 1] * from[1] + block[3 * a + 2] * from[2];
      }
    }
}

void fs_reduction_gather(const fs_reduction *r, const double *x, double *y) {
  memset(y, 0, 3 * (size_t)r->n_columns * sizeof *y);
  for (int32_t i = 0; i < r->n_rows; i++, x += 3)
    for (int32_t e = r->row_start[i]; e < r->row_start[i + 1]; e++) {
      double *to = y + 3 * (size_t)r->column[e];
      if (r->weight != NULL) {
        for (int a = 0; a < 3; a++) to[a] += r->weight[e] * x[a];
      } else {
        const double *block = r->block + 9 * (size_t)e;
        for (int a = 0; a < 3; a++) to[a] += block[a] * x[0] + block[3 + a] * x[1] + block[6 + a] * x[2];
      }
    }
}

/* ---- Hessian ----------------------------------------------------------------------------------------------------- */

/* The different columns of the rows in a set; counts only where list is NULL. mark[n_columns] holds set + 1. */
static int64_t columns_of(const fs_reduction *r, int32_t set, const int32_t *member, int64_t n_members, int32_t *mark,
                          int32_t *list) {
  int64_t n = 0;
  for (int64_t m = 0; m < n_members; m++) {
    if (member[m] == FS_NONE) continue;
    for (int32_t e = r->row_start[member[m]]; e < r->row_start[member[m] + 1]; e++) {
      if (mark[r->column[e]] == set + 1) continue;
      mark[r->column[e]] = set + 1;
      if (list != NULL) list[n] = r->column[e];
      n++;
    }
  }
  return n;
}

fs_status fs_reduction_pattern(fs_context *ctx, const fs_reduction *r, int32_t n_sets, const int64_t *set_start,
                               const int32_t *member, fs_sparse **pattern) {
  fs_status status = FS_OK;
  int64_t *start = NULL;
  int32_t *list = NULL, *mark = NULL;
  FS_ALLOC(ctx, start, (size_t)n_sets + 1);
  FS_ALLOC(ctx, mark, r->n_columns);
  for (int32_t s = 0; s < n_sets; s++)
    start[s + 1] = start[s] + columns_of(r, s, member + set_start[s], set_start[s + 1] - set_start[s], mark, NULL);
  FS_ALLOC(ctx, list, start[n_sets]);
  memset(mark, 0, (size_t)r->n_columns * sizeof *mark);
  for (int32_t s = 0; s < n_sets; s++)
    columns_of(r, s, member + set_start[s], set_start[s + 1] - set_start[s], mark, list + start[s]);
  FS_TRY(fs_sparse_create(ctx, r->n_columns, n_sets, start, list, pattern));
done:
  fs_release(ctx, start);
  fs_release(ctx, list);
  fs_release(ctx, mark);
  return status;
}

/* out = A B, or A^T B */
static void multiply(const double *A, const double *B, bool is_transposed, double *out) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double sum = 0;
      for (int k = 0; k < 3; k++) sum += (is_transposed ? A[3 * k + i] : A[3 * i + k]) * B[3 * k + j];
      out[3 * i + j] = sum;
    }
}

/* Adds T_ia^T H T_jb at (a, b) of the lower triangle, and where i != j its transpose at (b, a): the product is all that H
   says of the pair (i, j). */
static void add_product(const fs_reduction *r, const double *H, bool is_diagonal, int32_t p, int32_t q,
                        fs_sparse *reduced) {
  int32_t a = r->column[p], b = r->column[q];
  double right[9], block[9], turned[9];
  if (r->weight != NULL) {
    for (int k = 0; k < 9; k++) block[k] = r->weight[p] * r->weight[q] * H[k];
  } else {
    multiply(H, r->block + 9 * (size_t)q, false, right);
    multiply(r->block + 9 * (size_t)p, right, true, block);
  }
  if (a >= b) fs_sparse_add(reduced, a, b, block);
  if (is_diagonal || a > b) return;
  for (int k = 0; k < 9; k++) turned[k] = block[3 * (k % 3) + k / 3];
  fs_sparse_add(reduced, b, a, turned);
}

static void fill_idle(const fs_reduction *r, fs_sparse *reduced) {
  for (int32_t j = 0; r->is_idle != NULL && j < r->n_columns; j++) {
    const bool *is_idle = r->is_idle + 3 * (size_t)j;
    int32_t n = reduced->col_start[j + 1] - reduced->col_start[j], n_used = 0;
    double *value = reduced->value + 9 * (size_t)reduced->col_start[j], mean = 0;
    for (int c = 0; c < 3; c++)
      if (!is_idle[c]) mean += value[3 * (size_t)n * c + c], n_used++;
    mean = n_used > 0 ? mean / n_used : 0;
    for (int c = 0; c < 3; c++)
      if (is_idle[c]) value[3 * (size_t)n * c + c] = mean > 0 ? mean : 1;
  }
}

void fs_reduction_hessian(const fs_reduction *r, const fs_sparse *hessian, fs_sparse *reduced) {
  fs_sparse_clear(reduced);
  for (int32_t j = 0; j < hessian->n_blocks; j++) {
    int32_t n = hessian->col_start[j + 1] - hessian->col_start[j];
    const double *value = hessian->value + 9 * (size_t)hessian->col_start[j];
    for (int32_t k = 0; k < n; k++) {
      int32_t i = hessian->row[hessian->col_start[j] + k];
      double H[9];
      for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) H[3 * a + b] = value[3 * (size_t)n * b + 3 * (size_t)k + a];
      if (i == j) H[1] = H[3], H[2] = H[6], H[5] = H[7]; /* above the diagonal nothing need be meant */
      for (int32_t p = r->row_start[i]; p < r->row_start[i + 1]; p++)
        for (int32_t q = r->row_start[j]; q < r->row_start[j + 1]; q++) add_product(r, H, i == j, p, q, reduced);
    }
  }
  fill_idle(r, reduced);
}
