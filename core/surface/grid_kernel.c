/* SPDX-License-Identifier: MIT */
/* Single role: a tensor Bezier patch at all (u_i, v_j), with derivatives to order 3 (formulas as in kind_tensor_bezier.c): its
   points summed along v for each row j, then the row along u for vectors of nodes. */
#include "math/lanes.h"
#include "surface/jet.h"
#include "surface/points.h"

enum { N_ORDERS = 4, MAX_POINTS = FS_MAX_DEGREE + 1 };

/* basis of degree d, in place, to degree d + 1; differentiated where is_derivative */
static inline void raise(lanes *basis, int32_t d, lanes t, bool is_derivative) {
  basis[d + 1] = (lanes){0};
  for (int32_t i = d + 1; i >= 0; i--) {
    lanes before = i > 0 ? basis[i - 1] : (lanes){0};
    basis[i] = is_derivative ? (d + 1) * (before - basis[i]) : (1 - t) * basis[i] + t * before;
  }
}

/* basis[order][i][node]: derivatives of the Bernstein polynomials at n nodes. */
static void bernstein(int32_t degree, int32_t n, const double *t, double (*basis)[MAX_POINTS][FS_MAX_GRID]) {
  for (int32_t l = 0; l < n; l += FS_LANES) {
    lanes at = lanes_load(t + l), B[N_ORDERS][MAX_POINTS];
    for (int32_t order = 0; order < N_ORDERS; order++)
      for (int32_t i = 0; i <= degree; i++) B[order][i] = lanes_spread(i == 0 && order == 0);
    for (int32_t d = 0; d < degree; d++) { /* order k is differentiated from degree - k on */
      int32_t order = degree - d;
      for (int32_t i = 0; i <= d && order < N_ORDERS; i++) B[order][i] = B[0][i];
      raise(B[0], d, at, false);
    }
    for (int32_t order = 1; order < N_ORDERS && order <= degree; order++)
      for (int32_t d = degree - order; d < degree; d++) raise(B[order], d, at, true);
    for (int32_t order = 0; order < N_ORDERS; order++)
      for (int32_t i = 0; i <= degree; i++) lanes_store(&basis[order][i][l], B[order][i]);
  }
}

/* row[order][i][3] = sum over l of basis[order][l][j] point[l][i][3] */
static inline __attribute__((always_inline)) void sum_along_v(int32_t degree_u, int32_t degree_v, const double *point,
                                                              const double (*basis)[MAX_POINTS][FS_MAX_GRID], int32_t j,
                                                              double (*row)[3 * MAX_POINTS]) {
  const int32_t length = 3 * (degree_u + 1);
  for (int order = 0; order < N_ORDERS; order++) {
    for (int32_t i = 0; i < length; i++) row[order][i] = basis[order][0][j] * point[i];
    for (int32_t l = 1; l <= degree_v; l++)
      for (int32_t i = 0; i < length; i++) row[order][i] += basis[order][l][j] * point[l * length + i];
  }
}

static inline __attribute__((always_inline)) void run(int32_t degree_u, int32_t degree_v, const double *point,
                                                      int32_t n, const double *u, const double *v, double *out) {
  double by_u[N_ORDERS][MAX_POINTS][FS_MAX_GRID], by_v[N_ORDERS][MAX_POINTS][FS_MAX_GRID];
  double row[N_ORDERS][3 * MAX_POINTS];
  const size_t stride = (size_t)n * (size_t)n;
  bernstein(degree_u, n, u, by_u);
  bernstein(degree_v, n, v, by_v);
  for (int32_t j = 0; j < n; j++) {
    sum_along_v(degree_u, degree_v, point, (const double(*)[MAX_POINTS][FS_MAX_GRID])by_v, j, row);
    for (int32_t l = 0; l < n; l += FS_LANES)
      for (int a = 0; a < N_ORDERS; a++)
        for (int b = 0; a + b < N_ORDERS; b++) {
          lanes x[3] = {{0}};
          for (int32_t i = 0; i <= degree_u; i++) {
            lanes f = lanes_load(&by_u[a][i][l]);
            for (int c = 0; c < 3; c++) x[c] += f * row[b][3 * i + c];
          }
          for (int c = 0; c < 3; c++)
            lanes_store(out + (size_t)(3 * fs_jet_number[a][b] + c) * stride + (size_t)(n * j + l), x[c]);
        }
  }
}

void FS_KERNEL(fs_points_grid)(int32_t degree_u, int32_t degree_v, const double *point, int32_t n, const double *u,
                               const double *v, double *out);
void FS_KERNEL(fs_points_grid)(int32_t degree_u, int32_t degree_v, const double *point, int32_t n, const double *u,
                               const double *v, double *out) {
  if (degree_u == 3 && degree_v == 3) /* with its own loops, of constant length */
    run(3, 3, point, n, u, v, out);
  else
    run(degree_u, degree_v, point, n, u, v, out);
}
