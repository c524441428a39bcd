/* SPDX-License-Identifier: MIT */
/* Bezier triangles: p = sum_(i+j+k=n) n! / (i! j! k!) a^i u^j v^k b_ijk with a = 1 - u - v.

   De Casteljau's steps b_ijk <- a b_(i+1)jk + u b_i(j+1)k + v b_ij(k+1) lead from degree n to 0. The derivatives of order r
   are n! / (n - r)! times the differences of order r, (+u) b = b_i(j+1)k - b_(i+1)jk and (+v) likewise, of the net that is
   left at degree r   [Farin 2002, ch. 17]. */
#include "surface/surface.h"
#include "math/vec3.h"

size_t fs_bezier_triangle_numbers(const fs_patch *patch) {
  int32_t n = patch->degree_u;
  if (n < 1 || n > FS_MAX_DEGREE || patch->degree_v != n) return 0;
  return 3 * (size_t)((n + 1) * (n + 2) / 2);
}

/* Number of point j of row k in a net of degree n. */
static int32_t number(int32_t n, int32_t j, int32_t k) { return j + k * (2 * n + 3 - k) / 2; }

/* The net of degree n becomes that of degree n - 1, in place: rows move towards the front only. */
static void step(fs_vec3 *net, int32_t n, double a, double u, double v) {
  for (int32_t k = 0; k < n; k++)
    for (int32_t j = 0; j < n - k; j++) {
      fs_vec3 sum = fs_vec3_scale(net[number(n, j, k)], a);
      sum = fs_vec3_add_scaled(sum, net[number(n, j + 1, k)], u);
      net[number(n - 1, j, k)] = fs_vec3_add_scaled(sum, net[number(n, j, k + 1)], v);
    }
}

/* Differences of a net of degree n along u or v. */
static void difference(const fs_vec3 *net, int32_t n, bool is_v, fs_vec3 *out) {
  for (int32_t k = 0; k < n; k++)
    for (int32_t j = 0; j < n - k; j++)
      out[number(n - 1, j, k)] = fs_vec3_sub(net[number(n, j + !is_v, k + is_v)], net[number(n, j, k)]);
}

/* x[first .. first + order]: derivatives of that order, fewest by v first, from the net of degree = order. */
static void set_derivatives(const fs_vec3 *net, int32_t order, double factor, fs_vec3 *x) {
  for (int32_t n_v = 0; n_v <= order; n_v++) {
    fs_vec3 d[10];
    for (int32_t i = 0; i < (order + 1) * (order + 2) / 2; i++) d[i] = net[i];
    for (int32_t n = order; n > 0; n--) difference(d, n, n <= n_v, d);
    x[n_v] = fs_vec3_scale(d[0], factor);
  }
}

void fs_bezier_triangle_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x) {
  static const int32_t first[4] = {FS_D, FS_DU, FS_DUU, FS_DUUU};
  enum { N_POINTS = (FS_MAX_DEGREE + 1) * (FS_MAX_DEGREE + 2) / 2 };
  fs_vec3 net[N_POINTS];
  const double *b = data + patch->data_start;
  int32_t n = patch->degree_u, n_points = (int32_t)(fs_bezier_triangle_numbers(patch) / 3);
  for (int k = 0; k < FS_JET_SIZE; k++) x[k] = n_points > 0 ? (fs_vec3){0, 0, 0} : (fs_vec3){NAN, NAN, NAN};
  if (n_points == 0) return;
  for (int32_t i = 0; i < n_points; i++, b += 3) net[i] = (fs_vec3){b[0], b[1], b[2]};
  for (int32_t degree = n;; degree--) {
    if (degree <= 3) {
      double factor = 1;
      for (int32_t i = 0; i < degree; i++) factor *= n - i;
      set_derivatives(net, degree, factor, x + first[degree]);
    }
    if (degree == 0) return;
    step(net, degree, 1 - u - v, u, v);
  }
}
