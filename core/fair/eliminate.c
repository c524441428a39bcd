/* SPDX-License-Identifier: MIT */
/* Single role: elimination of sparse equations one by one [Gauss-Jordan]. A new equation loses the numbers that are solved
   for, is solved for the number with the largest coefficient that is left, and that number leaves the older equations. */
#include "fair/eliminate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

fs_status fs_elimination_create(fs_context *ctx, int32_t n, fs_elimination **elimination) {
  fs_status status = FS_OK;
  fs_elimination *e = NULL;
  FS_ALLOC(ctx, e, 1);
  e->n_numbers = n;
  FS_ALLOC(ctx, e->solved, n);
  FS_ALLOC(ctx, e->uses, n);
  FS_ALLOC(ctx, e->work, n);
  FS_ALLOC(ctx, e->touched, n);
  FS_ALLOC(ctx, e->solved_number, n);
  FS_ALLOC(ctx, e->is_touched, n);
  *elimination = e;
  e = NULL;
done:
  fs_elimination_free(ctx, e);
  return status;
}

static void row_free(fs_context *ctx, fs_row *row) {
  if (row == NULL) return;
  fs_release(ctx, row->column);
  fs_release(ctx, row->value);
  fs_release(ctx, row);
}

void fs_elimination_free(fs_context *ctx, fs_elimination *e) {
  if (e == NULL) return;
  for (int32_t i = 0; e->solved != NULL && i < e->n_numbers; i++) row_free(ctx, e->solved[i]);
  fs_release(ctx, e->solved);
  fs_release(ctx, e->uses);
  fs_release(ctx, e->work);
  fs_release(ctx, e->touched);
  fs_release(ctx, e->solved_number);
  fs_release(ctx, e->is_touched);
  fs_release(ctx, e);
}

void fs_elimination_add(fs_elimination *e, int32_t number, double value) {
  if (!e->is_touched[number]) {
    e->is_touched[number] = true;
    e->touched[e->n_touched++] = number;
  }
  e->work[number] += value;
}

static void clear(fs_elimination *e) {
  for (int32_t i = 0; i < e->n_touched; i++) {
    e->work[e->touched[i]] = 0;
    e->is_touched[e->touched[i]] = false;
  }
  e->n_touched = 0;
}

/* work -= factor times a solved equation, whose number is number; *right follows. */
static void substitute(fs_elimination *e, int32_t number, double *right) {
  const fs_row *row = e->solved[number];
  double factor = e->work[number];
  e->work[number] = 0;
  *right -= factor * row->right;
  for (int32_t k = 0; k < row->n; k++) fs_elimination_add(e, row->column[k], -factor * row->value[k]);
}

static int compare(const void *a, const void *b) {
  int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
  return (x > y) - (x < y);
}

/* The collected numbers other than skip whose coefficients exceed smallest, as a row. */
static fs_status collect(fs_context *ctx, fs_elimination *e, int32_t skip, double smallest, double right,
                         fs_row **result) {
  fs_status status = FS_OK;
  fs_row *row = NULL;
  qsort(e->touched, (size_t)e->n_touched, sizeof *e->touched, compare);
  FS_ALLOC(ctx, row, 1);
  FS_ALLOC(ctx, row->column, e->n_touched);
  FS_ALLOC(ctx, row->value, e->n_touched);
  row->right = right;
  for (int32_t i = 0; i < e->n_touched; i++) {
    int32_t number = e->touched[i];
    if (number == skip || fabs(e->work[number]) <= smallest) continue;
    row->column[row->n] = number;
    row->value[row->n++] = e->work[number];
  }
  *result = row;
  row = NULL;
done:
  row_free(ctx, row);
  return status;
}

static int32_t find(const fs_row *row, int32_t number) {
  int32_t low = 0, high = row->n;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (row->column[middle] < number)
      low = middle + 1;
    else
      high = middle;
  }
  return low < row->n && row->column[low] == number ? low : FS_NONE;
}

/* Takes a number that is solved for out of the older equations. */
static fs_status remove_from_others(fs_context *ctx, fs_elimination *e, int32_t number) {
  fs_status status = FS_OK;
  for (int32_t i = 0; i < e->n_solved && e->uses[number] > 0; i++) {
    fs_row *old = e->solved[e->solved_number[i]], *row = NULL;
    double right = old->right;
    if (find(old, number) == FS_NONE) continue;
    for (int32_t k = 0; k < old->n; k++) {
      fs_elimination_add(e, old->column[k], old->value[k]);
      e->uses[old->column[k]]--;
    }
    substitute(e, number, &right);
    FS_TRY(collect(ctx, e, number, 1e-16, right, &row));
    clear(e);
    for (int32_t k = 0; k < row->n; k++) e->uses[row->column[k]]++;
    e->solved[e->solved_number[i]] = row;
    row_free(ctx, old);
  }
done:
  clear(e);
  return status;
}

fs_status fs_elimination_finish(fs_context *ctx, fs_elimination *e, double right, double scale,
                                fs_elimination_result *result, double *residual) {
  fs_status status = FS_OK;
  fs_row *row = NULL;
  double largest = 0, pivot = 0;
  int32_t number = FS_NONE;
  for (int32_t i = 0; i < e->n_touched; i++) largest = fmax(largest, fabs(e->work[e->touched[i]]));
  for (int32_t i = 0, n = e->n_touched; i < n;
       i++) /* solved equations contain free numbers only: those added need no look */
    if (e->solved[e->touched[i]] != NULL) substitute(e, e->touched[i], &right);
  qsort(e->touched, (size_t)e->n_touched, sizeof *e->touched, compare);
  for (int32_t i = 0; i < e->n_touched; i++) {
    double size = fabs(e->work[e->touched[i]]);
    if (e->solved[e->touched[i]] == NULL && size > (1 + 1e-9) * pivot) pivot = size, number = e->touched[i];
  }
  *residual = fabs(right);
  if (pivot <= 1e-8 * largest) { /* what is left is the rounding of the numbers that were given */
    double noise = largest > 0 ? pivot / largest : 0;
    *result = *residual <= fmax(1e-10, 10 * noise) * scale ? FS_EQUATION_REDUNDANT : FS_EQUATION_CONTRADICTS;
    goto done;
  }
  *result = FS_EQUATION_NEW;
  pivot = e->work[number];
  for (int32_t i = 0; i < e->n_touched; i++) e->work[e->touched[i]] /= pivot;
  FS_TRY(collect(ctx, e, number, 1e-16, right / pivot, &row));
  clear(e);
  e->solved[number] = row;
  FS_TRY(remove_from_others(ctx, e, number));
  for (int32_t k = 0; k < row->n; k++) e->uses[row->column[k]]++;
  e->solved_number[e->n_solved++] = number;
done:
  clear(e);
  return status;
}
