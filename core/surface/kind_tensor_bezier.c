/* SPDX-License-Identifier: MIT */
/* Tensor Bezier patches: p(u, v) = sum_ij b_ij B_i^n(u) B_j^m(v).

   The basis of degree n is raised from degree 0 by B_i^n = (1 - t) B_i^(n-1) + t B_(i-1)^(n-1), which gives exact values at
   t = 0 and 1, and derivatives by (B_i^n)' = n (B_(i-1)^(n-1) - B_i^(n-1))   [Farin 2002, ch. 5]. */
#include "surface/jet.h"
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

/* basis[order][i]: derivatives 0 .. 3 of the Bernstein polynomials of the given degree at t. Order k leaves the way up to
   the degree at degree - k, from where on it is differentiated. */
static void bernstein(int32_t degree, double t, double basis[N_ORDERS][FS_MAX_DEGREE + 1]) {
  basis[0][0] = 1;
  for (int32_t order = 1; order < N_ORDERS; order++)
    for (int32_t i = 0; i <= degree && order > degree; i++) basis[order][i] = 0;
  for (int32_t d = 0; d < degree; d++) {
    int32_t order = degree - d;
    for (int32_t i = 0; i <= d && order < N_ORDERS; i++) basis[order][i] = basis[0][i];
    raise(basis[0], d, t, false);
  }
  for (int32_t order = 1; order < N_ORDERS && order <= degree; order++)
    for (int32_t d = degree - order; d < degree; d++) raise(basis[order], d, t, true);
}

/* An axis of the patch: the degree, how far apart its points are in the array, the basis at the parameter. */
typedef struct axis {
  int32_t degree, stride;
  double basis[N_ORDERS][FS_MAX_DEGREE + 1];
} axis;

/* sum[k] = sum over i of basis[k][i] point[stride i], k < n_orders, from both ends inwards: the same bits when the points
   come the other way round. */
static void sum_line(const axis *a, int32_t stride, const double *point, int n_orders, fs_vec3 *sum) {
  const double *low = point, *high = point + (ptrdiff_t)stride * a->degree;
  for (int k = 0; k < n_orders; k++) sum[k] = (fs_vec3){0, 0, 0};
  for (int32_t i = 0, j = a->degree; i <= j; i++, j--, low += stride, high -= stride)
    for (int k = 0; k < n_orders; k++) {
      double at_low = a->basis[k][i], at_high = i < j ? a->basis[k][j] : 0;
      sum[k].x += at_low * low[0] + at_high * high[0];
      sum[k].y += at_low * low[1] + at_high * high[1];
      sum[k].z += at_low * low[2] + at_high * high[2];
    }
}

/* x of all orders, summed along the first axis first. */
static void sum_lines(const axis *first, const axis *second, bool is_u_first, const double *point, fs_vec3 *x) {
  fs_vec3 line[N_ORDERS], column[N_ORDERS][FS_MAX_DEGREE + 1], sum[N_ORDERS];
  for (int32_t j = 0; j <= second->degree; j++, point += second->stride) {
    sum_line(first, first->stride, point, N_ORDERS, line);
    for (int a = 0; a < N_ORDERS; a++) column[a][j] = line[a];
  }
  for (int a = 0; a < N_ORDERS; a++) {
    sum_line(second, 3, &column[a][0].x, N_ORDERS - a, sum);
    for (int b = 0; b < N_ORDERS - a; b++) x[is_u_first ? fs_jet_number[a][b] : fs_jet_number[b][a]] = sum[b];
  }
}

/* Mirror images of patches give mirror images of points to the last bit, where 1 - u and 1 - v are exact: sums run from both
   ends inwards, and the axis whose parameter is farther from 1/2 comes first, whichever it is called. */
void fs_tensor_bezier_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x) {
  const double *point = data + patch->data_start;
  axis by_u, by_v;
  double from_middle = fabs(u - 0.5) - fabs(v - 0.5);
  by_u.degree = patch->degree_u, by_u.stride = 3;
  by_v.degree = patch->degree_v, by_v.stride = 3 * (patch->degree_u + 1);
  if (by_u.degree < 0 || by_v.degree < 0 || by_u.degree > FS_MAX_DEGREE || by_v.degree > FS_MAX_DEGREE) {
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = (fs_vec3){NAN, NAN, NAN};
    return;
  }
  bernstein(by_u.degree, u, by_u.basis);
  bernstein(by_v.degree, v, by_v.basis);
  if (from_middle > 0)
    sum_lines(&by_u, &by_v, true, point, x);
  else
    sum_lines(&by_v, &by_u, false, point, x);
  if (from_middle == 0) { /* neither is: the mean of both */
    fs_vec3 other[FS_JET_SIZE];
    sum_lines(&by_u, &by_v, true, point, other);
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = fs_vec3_scale(fs_vec3_add(x[k], other[k]), 0.5);
  }
}

size_t fs_tensor_bezier_numbers(const fs_patch *patch) {
  int32_t n = patch->degree_u, m = patch->degree_v;
  if (n < 1 || m < 1 || n > FS_MAX_DEGREE || m > FS_MAX_DEGREE) return 0;
  return 3 * (size_t)(n + 1) * (size_t)(m + 1);
}
