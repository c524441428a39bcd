/* SPDX-License-Identifier: MIT */
/* Single role: between derivatives by the parameters and derivatives by the coordinates of a chart, at a block of points.

     y: derivatives by (u, v),  z = A y: derivatives by the chart's coordinates,  A = inverse[9][9] per point.
     A density g(z) has by y the gradient A^T g' and the Hessian A^T g'' A.
   Derivatives of one order depend on those of this and lower orders only, so A is block lower triangular. */
#include "fair/lanes.h"
#include "fair/kernels.h"

static const int n_columns[N_DERIVATIVES] = {2, 2, 5, 5, 5, 9, 9, 9, 9}; /* of row k of A that may differ from zero */
static const int first_row[N_DERIVATIVES] = {0, 0, 2, 2, 2, 5, 5, 5, 5}; /* of column i */

void FS_KERNEL(fs_to_chart)(const double *inverse, const double *y, double *z) {
  for (int l = 0; l < FS_BLOCK; l += FS_LANES)
    for (int k = 0; k < N_DERIVATIVES; k++) {
      lanes sum[3] = {{0}};
      for (int i = 0; i < n_columns[k]; i++) {
        lanes a = lanes_load(inverse + (N_DERIVATIVES * k + i) * FS_BLOCK + l);
        for (int c = 0; c < 3; c++) sum[c] += a * lanes_load(y + (3 * i + c) * FS_BLOCK + l);
      }
      for (int c = 0; c < 3; c++) lanes_store(z + (3 * k + c) * FS_BLOCK + l, sum[c]);
    }
}

/* out[i][j] += A^T D A for i <= j and components (a, b), D given by the blocks of pairs. */
static inline void add_congruence(const lanes (*A)[N_DERIVATIVES], const double *ddf, int a, int b, lanes scale, int l,
                                  double *out) {
  lanes DA[N_DERIVATIVES][N_DERIVATIVES];
  for (int k = 0; k < N_DERIVATIVES; k++) {
    lanes row[N_DERIVATIVES];
    for (int m = 0; m < N_DERIVATIVES; m++) {
      const double *block = ddf + (size_t)(k <= m ? pair_of(k, m) : pair_of(m, k)) * 9 * FS_BLOCK + l;
      row[m] = scale * lanes_load(block + (k <= m ? 3 * a + b : 3 * b + a) * FS_BLOCK);
    }
    for (int j = 0; j < N_DERIVATIVES; j++) {
      lanes sum = {0};
      for (int m = first_row[j]; m < N_DERIVATIVES; m++) sum += row[m] * A[m][j];
      DA[k][j] = sum;
    }
  }
  for (int i = 0; i < N_DERIVATIVES; i++)
    for (int j = i; j < N_DERIVATIVES; j++) {
      double *to = out + ((size_t)pair_of(i, j) * 9 + 3 * a + b) * FS_BLOCK + l;
      lanes sum = lanes_load(to);
      for (int k = first_row[i]; k < N_DERIVATIVES; k++) sum += A[k][i] * DA[k][j];
      lanes_store(to, sum);
    }
}

void FS_KERNEL(fs_add_from_chart)(const double *inverse, const double *scale, const double *df, const double *ddf,
                                  double *sum_df, double *sum_ddf) {
  for (int l = 0; l < FS_BLOCK; l += FS_LANES) {
    lanes A[N_DERIVATIVES][N_DERIVATIVES], s = lanes_load(scale + l);
    for (int k = 0; k < N_DERIVATIVES; k++)
      for (int i = 0; i < N_DERIVATIVES; i++) A[k][i] = lanes_load(inverse + (N_DERIVATIVES * k + i) * FS_BLOCK + l);
    for (int i = 0; i < N_DERIVATIVES; i++)
      for (int c = 0; c < 3; c++) {
        double *to = sum_df + (3 * i + c) * FS_BLOCK + l;
        lanes sum = {0};
        for (int k = first_row[i]; k < N_DERIVATIVES; k++) sum += A[k][i] * lanes_load(df + (3 * k + c) * FS_BLOCK + l);
        lanes_store(to, lanes_load(to) + s * sum);
      }
    if (ddf == NULL) continue;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) add_congruence((const lanes(*)[N_DERIVATIVES])A, ddf, a, b, s, l, sum_ddf);
  }
}
