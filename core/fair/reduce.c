/* SPDX-License-Identifier: MIT */
/* Single role: an affine map of the unknowns, applied to points, gradients and Hessians:
     x = x0 + T y,   g_y = T^T g,   H_y = T^T H T = A + A^T,  A = T^T L T,
   L the lower triangle of H with half its diagonal. A is made column by column of L: first w = T^T L_j, then w T_j. */
#include "fair/reduce.h"
#include "fair/coarse_squares.h"

#include <string.h>

void fs_reduction_free(fs_context *ctx, fs_reduction *r) {
  if (r == NULL) return;
  fs_release(ctx, r->row_start);
  fs_release(ctx, r->column);
  fs_release(ctx, r->block);
  fs_release(ctx, r->weight);
  fs_release(ctx, r->x0);
  fs_release(ctx, r->is_idle);
  fs_coarse_squares_free(ctx, r->squares);
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

/* The part of T^T L_j that is not zero: n blocks, their rows, and where each row is in the list. */
typedef struct gathered {
  int32_t n, *row, *place; /* [n_columns]; place: 1 + number in the list, 0: not in it */
  double *block;           /* [n_columns][9] */
} gathered;

/* w_a += T_ia^T L_ij for the entries e of row i. */
static void gather_block(const fs_reduction *r, int32_t e, const double *L, gathered *w) {
  int32_t a = r->column[e];
  double *to;
  if (w->place[a] == 0) {
    w->row[w->n++] = a;
    w->place[a] = w->n;
    memset(w->block + 9 * (size_t)(w->n - 1), 0, 9 * sizeof *w->block);
  }
  to = w->block + 9 * (size_t)(w->place[a] - 1);
  if (r->weight != NULL) {
    for (int k = 0; k < 9; k++) to[k] += r->weight[e] * L[k];
  } else {
    const double *T = r->block + 9 * (size_t)e;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) to[3 * i + j] += T[i] * L[j] + T[3 + i] * L[3 + j] + T[6 + i] * L[6 + j];
  }
}

/* Adds X = w_a T_jb and its transpose. */
static void add_product(const fs_reduction *r, int32_t e, int32_t a, const double *w, fs_sparse *reduced) {
  int32_t b = r->column[e];
  double X[9], turned[9];
  if (r->weight != NULL) {
    for (int k = 0; k < 9; k++) X[k] = r->weight[e] * w[k];
  } else {
    const double *T = r->block + 9 * (size_t)e;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) X[3 * i + j] = w[3 * i] * T[j] + w[3 * i + 1] * T[3 + j] + w[3 * i + 2] * T[6 + j];
  }
  if (a >= b) fs_sparse_add(reduced, a, b, X);
  if (a > b) return;
  for (int k = 0; k < 9; k++) turned[k] = X[3 * (k % 3) + k / 3];
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

/* Block k of column j of the lower triangle, half of it on the diagonal. */
static void get_block(const fs_sparse *hessian, int32_t j, int32_t k, double *L) {
  size_t n = (size_t)(hessian->col_start[j + 1] - hessian->col_start[j]);
  const double *value = hessian->value + 9 * (size_t)hessian->col_start[j];
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) L[3 * a + b] = value[3 * n * (size_t)b + 3 * (size_t)k + (size_t)a];
  if (k > 0) return;
  L[1] = L[3], L[2] = L[6], L[5] = L[7]; /* above the diagonal nothing need be meant */
  for (int i = 0; i < 9; i++) L[i] *= 0.5;
}

fs_status fs_reduction_hessian(fs_context *ctx, const fs_reduction *r, const fs_sparse *hessian, fs_sparse *reduced) {
  fs_status status = FS_OK;
  gathered w = {0};
  FS_ALLOC(ctx, w.row, r->n_columns);
  FS_ALLOC(ctx, w.place, r->n_columns);
  FS_ALLOC(ctx, w.block, 9 * (size_t)r->n_columns);
  fs_sparse_clear(reduced);
  for (int32_t j = 0; j < hessian->n_blocks; j++) {
    int32_t n = hessian->col_start[j + 1] - hessian->col_start[j];
    if (r->row_start[j] == r->row_start[j + 1]) continue;
    w.n = 0;
    for (int32_t k = 0; k < n; k++) {
      int32_t i = hessian->row[hessian->col_start[j] + k];
      double L[9];
      get_block(hessian, j, k, L);
      for (int32_t e = r->row_start[i]; e < r->row_start[i + 1]; e++) gather_block(r, e, L, &w);
    }
    for (int32_t e = r->row_start[j]; e < r->row_start[j + 1]; e++)
      for (int32_t k = 0; k < w.n; k++) add_product(r, e, w.row[k], w.block + 9 * (size_t)k, reduced);
    for (int32_t k = 0; k < w.n; k++) w.place[w.row[k]] = 0;
  }
  fill_idle(r, reduced);
done:
  fs_release(ctx, w.row);
  fs_release(ctx, w.place);
  fs_release(ctx, w.block);
  return status;
}
