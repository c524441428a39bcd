/* SPDX-License-Identifier: MIT */
/* Single role: orthonormal null space by Householder reflections with pivoting. [Golub Van Loan 2013 section 5.4]

   H_r .. H_2 H_1 A^T P = (upper triangle of r rows; 0), r the rank. The last columns of Q = H_1 H_2 .. H_r are
   orthogonal to all rows of A. H = I - 2 v v^T with |v| = 1. */
#include "math/dense.h"

#include <math.h>
#include <string.h>

static double dot(int32_t n, const double *a, const double *b) {
  double sum = 0;
  for (int32_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/* x = (I - 2 v v^T) x */
static void reflect(int32_t n, const double *v, double *x) {
  double twice = 2 * dot(n, v, x);
  for (int32_t i = 0; i < n; i++) x[i] -= twice * v[i];
}

/* The row from first on that is longest beyond its column first; *length is that length. */
static int32_t longest_row(int32_t rows, int32_t columns, const double *W, int32_t first, double *length) {
  int32_t best = first;
  *length = 0;
  for (int32_t i = first; i < rows; i++) {
    const double *x = W + i * columns + first;
    double size = sqrt(dot(columns - first, x, x));
    if (size > *length) *length = size, best = i;
  }
  return best;
}

/* Takes the row longest beyond column s as the next one, makes its reflector v [columns] (zero before s), applies it;
   returns its length. */
static double eliminate(int32_t rows, int32_t columns, double *W, int32_t s, double *v) {
  double length;
  int32_t pivot = longest_row(rows, columns, W, s, &length);
  double *x = W + s * columns, size;
  if (length == 0) return 0;
  for (int32_t j = 0; j < columns; j++) {
    double swap = x[j];
    x[j] = W[pivot * columns + j];
    W[pivot * columns + j] = swap;
  }
  memcpy(v + s, x + s, (size_t)(columns - s) * sizeof *v);
  v[s] += v[s] < 0 ? -length : length; /* the sign that does not cancel */
  size = sqrt(dot(columns - s, v + s, v + s));
  for (int32_t j = s; j < columns; j++) v[j] /= size;
  for (int32_t i = s; i < rows; i++) reflect(columns - s, v + s, W + i * columns + s);
  return length;
}

fs_status fs_dense_null_space(fs_context *ctx, int32_t rows, int32_t columns, const double *A, int32_t rank,
                              double *basis) {
  fs_status status = FS_OK;
  double *W = NULL, *v = NULL; /* [rows][columns], [rank][columns] */
  double first = 0, length = 0;
  if (rank < 0 || rank > rows || rank > columns)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a matrix of %d rows and %d columns cannot have rank %d", rows, columns, rank);
  FS_ALLOC(ctx, W, rows * columns);
  FS_ALLOC(ctx, v, rank * columns);
  memcpy(W, A, (size_t)rows * (size_t)columns * sizeof *W);
  for (int32_t s = 0; s < rank; s++) {
    length = eliminate(rows, columns, W, s, v + s * columns);
    if (s == 0) first = length;
    if (!(length > 1e-9 * first)) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "null space: the matrix has rank %d instead of %d", s, rank);
      goto done;
    }
  }
  longest_row(rows, columns, W, rank, &length);
  if (length > 1e-9 * first || !isfinite(first)) {
    status = fs_fail(ctx, FS_ERR_NUMERIC, "null space: the rank of the matrix exceeds %d", rank);
    goto done;
  }
  memset(basis, 0, (size_t)(columns - rank) * (size_t)columns * sizeof *basis);
  for (int32_t i = 0; i < columns - rank; i++) {
    double *x = basis + i * columns;
    x[rank + i] = 1;
    for (int32_t s = rank - 1; s >= 0; s--) reflect(columns, v + s * columns, x);
  }
done:
  fs_release(ctx, W);
  fs_release(ctx, v);
  return status;
}
