/* SPDX-License-Identifier: MIT */
/* Single role: sparse matrices by rows, as refinements compose them: products, and columns in ascending order. */
#include "refine/refine.h"

fs_status fs_stencils_allocate(fs_context *ctx, int32_t n_rows, int32_t n_columns, int32_t n_entries,
                               fs_stencils *stencils) {
  fs_stencils result = {.n_rows = n_rows, .n_columns = n_columns};
  fs_status status = FS_OK;
  FS_ALLOC(ctx, result.start, (size_t)n_rows + 1);
  FS_ALLOC(ctx, result.column, n_entries);
  FS_ALLOC(ctx, result.weight, n_entries);
  *stencils = result;
done:
  if (status != FS_OK) fs_stencils_release(ctx, &result);
  return status;
}

void fs_stencils_release(fs_context *ctx, fs_stencils *stencils) {
  fs_release(ctx, stencils->start);
  fs_release(ctx, stencils->column);
  fs_release(ctx, stencils->weight);
  *stencils = (fs_stencils){0};
}

/* Number of different columns in all rows of the product; seen[right->n_columns] remembers the last row of a column. */
static int64_t product_entries(const fs_stencils *left, const fs_stencils *right, int32_t *seen) {
  int64_t n = 0;
  for (int32_t row = 0; row < left->n_rows && n <= INT32_MAX; row++)
    for (int32_t i = left->start[row]; i < left->start[row + 1]; i++)
      for (int32_t j = right->start[left->column[i]]; j < right->start[left->column[i] + 1]; j++) {
        if (seen[right->column[j]] == row + 1) continue;
        seen[right->column[j]] = row + 1;
        n++;
      }
  return n;
}

/* Fills the product; place[column] - 1 is where the current row keeps a column, if it is not before the row's start. */
static void product_fill(const fs_stencils *left, const fs_stencils *right, int32_t *place, fs_stencils *product) {
  int32_t n = 0;
  for (int32_t row = 0; row < left->n_rows; row++) {
    product->start[row] = n;
    for (int32_t i = left->start[row]; i < left->start[row + 1]; i++)
      for (int32_t j = right->start[left->column[i]]; j < right->start[left->column[i] + 1]; j++) {
        int32_t column = right->column[j];
        if (place[column] <= product->start[row]) {
          product->column[n++] = column;
          place[column] = n;
        }
        product->weight[place[column] - 1] += left->weight[i] * right->weight[j];
      }
  }
  product->start[left->n_rows] = n;
}

fs_status fs_stencils_multiply(fs_context *ctx, const fs_stencils *left, const fs_stencils *right,
                               fs_stencils *product) {
  int32_t *seen = NULL, *place = NULL;
  fs_stencils result = {0};
  fs_status status = FS_OK;
  int64_t n_entries;
  FS_ALLOC(ctx, seen, right->n_columns);
  n_entries = product_entries(left, right, seen);
  if (n_entries > INT32_MAX) {
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "the matrix of the refinement would have more than %d entries", INT32_MAX);
    goto done;
  }
  FS_ALLOC(ctx, place, right->n_columns);
  FS_TRY(fs_stencils_allocate(ctx, left->n_rows, right->n_columns, (int32_t)n_entries, &result));
  product_fill(left, right, place, &result);
  *product = result;
done:
  fs_release(ctx, seen);
  fs_release(ctx, place);
  return status;
}

/* Filling the transpose row by row leaves its columns in ascending order. */
static fs_status transpose(fs_context *ctx, const fs_stencils *a, fs_stencils *transposed) {
  int32_t n_entries = a->start[a->n_rows];
  int32_t *next = NULL; /* next free place of each row of the transpose */
  fs_stencils t = {0};
  fs_status status = FS_OK;
  FS_TRY(fs_stencils_allocate(ctx, a->n_columns, a->n_rows, n_entries, &t));
  FS_ALLOC(ctx, next, t.n_rows);
  for (int32_t i = 0; i < n_entries; i++) t.start[a->column[i] + 1]++;
  for (int32_t row = 0; row < t.n_rows; row++) {
    t.start[row + 1] += t.start[row];
    next[row] = t.start[row];
  }
  for (int32_t row = 0; row < a->n_rows; row++)
    for (int32_t i = a->start[row]; i < a->start[row + 1]; i++) {
      int32_t place = next[a->column[i]]++;
      t.column[place] = row;
      t.weight[place] = a->weight[i];
    }
  *transposed = t;
  t = (fs_stencils){0};
done:
  fs_release(ctx, next);
  fs_stencils_release(ctx, &t);
  return status;
}

fs_status fs_stencils_sort(fs_context *ctx, fs_stencils *stencils) {
  fs_stencils transposed = {0}, sorted = {0};
  fs_status status = FS_OK;
  FS_TRY(transpose(ctx, stencils, &transposed));
  FS_TRY(transpose(ctx, &transposed, &sorted));
  fs_stencils_release(ctx, stencils);
  *stencils = sorted;
done:
  fs_stencils_release(ctx, &transposed);
  return status;
}
