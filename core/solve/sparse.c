/* SPDX-License-Identifier: MIT */
/* Single role: the pattern and the values of a symmetric matrix of 3x3 blocks. */
#include "solve/sparse.h"

#include <stdlib.h>
#include <string.h>

static int compare(const void *a, const void *b) {
  int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
  return (x > y) - (x < y);
}

/* The sets that each block row belongs to: sets_start[n_blocks + 1], sets[..]. */
static fs_status invert(fs_context *ctx, int32_t n_blocks, int32_t n_sets, const int64_t *set_start,
                        const int32_t *member, int64_t **sets_start, int32_t **sets) {
  fs_status status = FS_OK;
  int64_t *start = NULL;
  int32_t *list = NULL;
  FS_ALLOC(ctx, start, (size_t)n_blocks + 2);
  for (int64_t m = 0; m < set_start[n_sets]; m++)
    if (member[m] != FS_NONE) start[member[m] + 2]++;
  for (int32_t i = 0; i < n_blocks; i++) start[i + 2] += start[i + 1];
  FS_ALLOC(ctx, list, start[n_blocks + 1]);
  for (int32_t s = 0; s < n_sets; s++)
    for (int64_t m = set_start[s]; m < set_start[s + 1]; m++)
      if (member[m] != FS_NONE) list[start[member[m] + 1]++] = s;
  *sets_start = start;
  *sets = list;
  start = NULL;
  list = NULL;
done:
  fs_release(ctx, start);
  fs_release(ctx, list);
  return status;
}

/* Rows of column j: the members >= j of all sets of j, each once. Counts only where row is NULL. */
static int64_t column(int32_t j, const int64_t *sets_start, const int32_t *sets, const int64_t *set_start,
                      const int32_t *member, int32_t *mark, int32_t *row) {
  int64_t n = 1;
  mark[j] = j + 1;
  if (row != NULL) row[0] = j;
  for (int64_t s = sets_start[j]; s < sets_start[j + 1]; s++)
    for (int64_t m = set_start[sets[s]]; m < set_start[sets[s] + 1]; m++) {
      int32_t i = member[m];
      if (i <= j || mark[i] == j + 1) continue; /* FS_NONE is less than any j */
      mark[i] = j + 1;
      if (row != NULL) row[n] = i;
      n++;
    }
  if (row != NULL) qsort(row, (size_t)n, sizeof *row, compare);
  return n;
}

fs_status fs_sparse_create(fs_context *ctx, int32_t n_blocks, int32_t n_sets, const int64_t *set_start,
                           const int32_t *member, fs_sparse **sparse) {
  fs_status status = FS_OK;
  fs_sparse *a = NULL;
  int64_t *sets_start = NULL, total = 0;
  int32_t *sets = NULL, *mark = NULL;
  FS_ALLOC(ctx, a, 1);
  a->n_blocks = n_blocks;
  FS_TRY(invert(ctx, n_blocks, n_sets, set_start, member, &sets_start, &sets));
  FS_ALLOC(ctx, mark, n_blocks);
  FS_ALLOC(ctx, a->col_start, (size_t)n_blocks + 1);
  for (int32_t j = 0; j < n_blocks; j++) {
    total += column(j, sets_start, sets, set_start, member, mark, NULL);
    if (total > INT32_MAX / 9) {
      status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "the matrix of %d unknown points has too many entries", n_blocks);
      goto done;
    }
    a->col_start[j + 1] = (int32_t)total;
  }
  FS_ALLOC(ctx, a->row, total);
  memset(mark, 0, (size_t)n_blocks * sizeof *mark);
  for (int32_t j = 0; j < n_blocks; j++) column(j, sets_start, sets, set_start, member, mark, a->row + a->col_start[j]);
  FS_ALLOC(ctx, a->value, 9 * (size_t)total);
  *sparse = a;
  a = NULL;
done:
  fs_release(ctx, sets_start);
  fs_release(ctx, sets);
  fs_release(ctx, mark);
  fs_sparse_free(ctx, a);
  return status;
}

void fs_sparse_free(fs_context *ctx, fs_sparse *a) {
  if (a == NULL) return;
  fs_release(ctx, a->col_start);
  fs_release(ctx, a->row);
  fs_release(ctx, a->value);
  fs_release(ctx, a);
}

void fs_sparse_clear(fs_sparse *a) { memset(a->value, 0, 9 * (size_t)a->col_start[a->n_blocks] * sizeof *a->value); }

void fs_sparse_add(fs_sparse *a, int32_t i, int32_t j, const double *block) {
  int32_t low = a->col_start[j], high = a->col_start[j + 1], n = high - low;
  while (high - low > 1) {
    int32_t middle = low + (high - low) / 2;
    if (a->row[middle] <= i)
      low = middle;
    else
      high = middle;
  }
  double *value = a->value + 9 * (size_t)a->col_start[j] + 3 * (size_t)(low - a->col_start[j]);
  for (int c = 0; c < 3; c++, value += 3 * (size_t)n)
    for (int r = 0; r < 3; r++) value[r] += block[3 * r + c];
}

void fs_sparse_diagonal(const fs_sparse *a, double *mean) {
  for (int32_t j = 0; j < a->n_blocks; j++) {
    size_t column = 3 * (size_t)(a->col_start[j + 1] - a->col_start[j]);
    const double *value = a->value + 9 * (size_t)a->col_start[j];
    mean[j] = (value[0] + value[column + 1] + value[2 * column + 2]) / 3.0;
  }
}

void fs_sparse_multiply(const fs_sparse *a, const double *x, double *y) {
  memset(y, 0, 3 * (size_t)a->n_blocks * sizeof *y);
  for (int32_t j = 0; j < a->n_blocks; j++) {
    int32_t n = a->col_start[j + 1] - a->col_start[j];
    for (int c = 0; c < 3; c++) {
      const double *value = a->value + 9 * (size_t)a->col_start[j] + 3 * (size_t)n * c;
      size_t k = 3 * (size_t)j + c;
      for (int32_t b = 0; b < n; b++)
        for (int r = 0; r < 3; r++) {
          size_t i = 3 * (size_t)a->row[a->col_start[j] + b] + r;
          if (i < k) continue;
          y[i] += value[3 * b + r] * x[k];
          if (i != k) y[k] += value[3 * b + r] * x[i];
        }
    }
  }
}
