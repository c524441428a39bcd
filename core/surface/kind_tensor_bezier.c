/* SPDX-License-Identifier: MIT */
/* Tensor Bezier patches: p(u, v) = sum_ij b_ij B_i^n(u) B_j^m(v).

   The basis of degree n is raised from degree 0 by B_i^n = (1 - t) B_i^(n-1) + t B_(i-1)^(n-1), which gives exact values at
   t = 0 and 1, and derivatives by (B_i^n)' = n (B_(i-1)^(n-1) - B_i^(n-1))   [Farin 2002, ch. 5]. */
#include "surface/surface.h"
#include "math/vec3.h"

enum { N_ORDERS = 4 };

/* basis of degree d, in place, to degree d + 1; differentiated where is_derivative */
static void raise(double *basis, int32_t d, double t, bool is_derivative) {
  basis[d + 1] = 0;
  for (int32_t i = d + 1; i >= 0; i--) {
    double before = i > 0 ? basis[i - 1] : 0;
    basis[i] = is_derivative ? (d + 1) * (before - basis[i]) : (1 - t) * basis[i] + t * before;
  }
}

/* basis[order][i]: derivatives 0 .. 3 of the Bernstein polynomials of the given degree at t */
static void bernstein(int32_t degree, double t, double basis[N_ORDERS][FS_MAX_DEGREE + 1]) {
  for (int32_t order = 0; order < N_ORDERS; order++) {
    basis[order][0] = order <= degree ? 1 : 0;
    for (int32_t d = 0; d < degree; d++) raise(basis[order], d, t, d >= degree - order);
  }
}

void fs_tensor_bezier_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x) {
  static const int8_t order_u[FS_JET_SIZE] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  static const int8_t order_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};
  double basis_u[N_ORDERS][FS_MAX_DEGREE + 1], basis_v[N_ORDERS][FS_MAX_DEGREE + 1];
  int32_t n = patch->degree_u, m = patch->degree_v;
  if (n < 0 || m < 0 || n > FS_MAX_DEGREE || m > FS_MAX_DEGREE) {
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = (fs_vec3){NAN, NAN, NAN};
    return;
  }
  bernstein(n, u, basis_u);
  bernstein(m, v, basis_v);
  for (int k = 0; k < FS_JET_SIZE; k++) x[k] = (fs_vec3){0, 0, 0};
  const double *point = data + patch->data_start;
  for (int32_t j = 0; j <= m; j++) {
    fs_vec3 row[N_ORDERS] = {{0, 0, 0}}; /* derivatives by u of row j */
    for (int32_t i = 0; i <= n; i++, point += 3)
      for (int k = 0; k < N_ORDERS; k++)
        row[k] = fs_vec3_add_scaled(row[k], (fs_vec3){point[0], point[1], point[2]}, basis_u[k][i]);
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = fs_vec3_add_scaled(x[k], row[order_u[k]], basis_v[order_v[k]][j]);
  }
}

size_t fs_tensor_bezier_numbers(const fs_patch *patch) {
  int32_t n = patch->degree_u, m = patch->degree_v;
  if (n < 1 || m < 1 || n > FS_MAX_DEGREE || m > FS_MAX_DEGREE) return 0;
  return 3 * (size_t)(n + 1) * (size_t)(m + 1);
}
