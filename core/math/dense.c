/* SPDX-License-Identifier: MIT */
/* Single role: dense products, Cholesky factorisation and triangular solves, row-major. [Golub Van Loan 2013, section
   4.2]

   Blocked Cholesky A = R^T R, block rows of BLOCK:    R11^T R11 = A11        unblocked
                                                       R12 = R11^-T A12       solves along the rows of A12
                                                       A22 -= R12^T R12       the symmetric update, most of the work */
#include "math/dense.h"

#include <math.h>

enum { TILE_ROWS = 4, TILE_COLUMNS = 8, SLAB = 64, BLOCK = 48 };

/* C [4][8] += sign times the columns i .. i+3 of A, transposed, times its columns j .. j+7. */
static void add_full_tile(int32_t rows, const double *restrict Ai, const double *restrict Aj, int32_t a_stride,
                          double sign, double *restrict C, int32_t c_stride) {
  double sum[TILE_ROWS][TILE_COLUMNS] = {{0}};
  for (int32_t r = 0; r < rows; r++, Ai += a_stride, Aj += a_stride)
    for (int32_t i = 0; i < TILE_ROWS; i++)
      for (int32_t j = 0; j < TILE_COLUMNS; j++) sum[i][j] += Ai[i] * Aj[j];
  for (int32_t i = 0; i < TILE_ROWS; i++)
    for (int32_t j = 0; j < TILE_COLUMNS; j++) C[i * c_stride + j] += sign * sum[i][j];
}

/* The same for the tiles cut off by the right or lower end of C. */
static void add_part_tile(int32_t rows, int32_t height, int32_t width, const double *Ai, const double *Aj,
                          int32_t a_stride, double sign, double *C, int32_t c_stride) {
  for (int32_t i = 0; i < height; i++)
    for (int32_t j = 0; j < width; j++) {
      double sum = 0;
      for (int32_t r = 0; r < rows; r++) sum += Ai[r * a_stride + i] * Aj[r * a_stride + j];
      C[i * c_stride + j] += sign * sum;
    }
}

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

void fs_dense_add_gram(int32_t rows, int32_t n, const double *A, int32_t a_stride, double sign, double *C,
                       int32_t c_stride) {
  for (int32_t start = 0; start < rows; start += SLAB) { /* a slab of A stays in the cache */
    const double *slab = A + start * a_stride;
    int32_t depth = smaller(SLAB, rows - start);
    for (int32_t i = 0; i < n; i += TILE_ROWS)
      for (int32_t j = i; j < n; j += TILE_COLUMNS) {
        int32_t height = smaller(TILE_ROWS, n - i), width = smaller(TILE_COLUMNS, n - j);
        if (height == TILE_ROWS && width == TILE_COLUMNS)
          add_full_tile(depth, slab + i, slab + j, a_stride, sign, C + i * c_stride + j, c_stride);
        else
          add_part_tile(depth, height, width, slab + i, slab + j, a_stride, sign, C + i * c_stride + j, c_stride);
      }
  }
}

void fs_dense_mirror(int32_t n, double *C, int32_t stride) {
  for (int32_t i = 0; i < n; i++)
    for (int32_t j = 0; j < i; j++) C[i * stride + j] = C[j * stride + i];
}

/* c += s b */
static void add_scaled_row(int32_t width, double s, const double *restrict b, double *restrict c) {
  for (int32_t w = 0; w < width; w++) c[w] += s * b[w];
}

void fs_dense_add_product(int32_t rows, int32_t inner, int32_t columns, double factor, const double *A,
                          int32_t a_stride, const double *B, int32_t b_stride, double *C, int32_t c_stride) {
  for (int32_t i = 0; i < rows; i++)
    for (int32_t l = 0; l < inner; l++)
      add_scaled_row(columns, factor * A[i * a_stride + l], B + l * b_stride, C + i * c_stride);
}

void fs_dense_add_product_transposed(int32_t rows, int32_t inner, int32_t columns, double factor, const double *A,
                                     int32_t a_stride, const double *B, int32_t b_stride, double *C, int32_t c_stride) {
  for (int32_t i = 0; i < rows; i++)
    for (int32_t l = 0; l < inner; l++)
      add_scaled_row(columns, factor * A[l * a_stride + i], B + l * b_stride, C + i * c_stride);
}

/* Factors the block [n][n] at A without blocking; returns the row of the first pivot that is not positive, or n. */
static int32_t factor_block(int32_t n, double *A, int32_t stride) {
  for (int32_t i = 0; i < n; i++) {
    double *row = A + i * stride, pivot = row[i];
    if (!(pivot > 0) || !isfinite(pivot)) return i;
    pivot = sqrt(pivot);
    for (int32_t j = i; j < n; j++) row[j] /= pivot;
    for (int32_t l = i + 1; l < n; l++) add_scaled_row(n - l, -row[l], row + l, A + l * stride + l);
  }
  return n;
}

fs_status fs_dense_cholesky(fs_context *ctx, int32_t n, double *A, int32_t stride) {
  for (int32_t start = 0; start < n; start += BLOCK) {
    int32_t size = smaller(BLOCK, n - start), rest = n - start - size;
    double *R11 = A + start * stride + start, *R12 = R11 + size, *A22 = R12 + size * stride;
    int32_t done = factor_block(size, R11, stride);
    if (done < size)
      return fs_fail(ctx, FS_ERR_NUMERIC, "Cholesky: the matrix of %d rows is not positive definite at row %d", n,
                     start + done);
    fs_dense_solve_transposed(size, R11, stride, rest, R12, stride);
    fs_dense_add_gram(size, rest, R12, stride, -1, A22, stride);
  }
  return FS_OK;
}

void fs_dense_solve_transposed(int32_t n, const double *R, int32_t stride, int32_t width, double *B, int32_t b_stride) {
  for (int32_t i = 0; i < n; i++) {
    double *b = B + i * b_stride;
    for (int32_t w = 0; w < width; w++) b[w] /= R[i * stride + i];
    for (int32_t j = i + 1; j < n; j++) add_scaled_row(width, -R[i * stride + j], b, B + j * b_stride);
  }
}

void fs_dense_solve_upper(int32_t n, const double *R, int32_t stride, int32_t width, double *B, int32_t b_stride) {
  for (int32_t i = n - 1; i >= 0; i--) {
    double *b = B + i * b_stride;
    for (int32_t j = i + 1; j < n; j++) add_scaled_row(width, -R[i * stride + j], B + j * b_stride, b);
    for (int32_t w = 0; w < width; w++) b[w] /= R[i * stride + i];
  }
}
