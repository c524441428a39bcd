/* SPDX-License-Identifier: MIT */
/* Stacho's triangles in space: a Bezier triangle B of degree n with a correction for each side,

     S = B + sum_s c a^2 b^2 V_s(t),  t = (1 + a - b) / 2,  V = - delta W / (N . W),  W = N or constant,

   with a, b, c the barycentric coordinates of corners s, s + 1, s + 2 for side s. On its side t = a; c a^2 b^2 vanishes
   there, and with its first derivatives on the two other sides, so corrections do not meet. The quotient is differentiated
   by q V^(m) = P^(m) - sum_(r=1)^m C(m, r) q^(r) V^(m-r)   [docs/stacho.md]. */
#include "surface/jet.h"
#include "surface/stacho.h"
#include "surface/surface.h"
#include "math/bernstein.h"
#include "math/vec3.h"

enum { N_ORDERS = 4, MAX_TERMS = 3 * FS_STACHO_HIGHEST - 6 };

static const double binomial[N_ORDERS][N_ORDERS] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};

size_t fs_stacho_triangle_numbers(const fs_patch *patch) {
  int32_t n = patch->degree_u;
  if (n < FS_STACHO_LOWEST || n > FS_STACHO_HIGHEST || patch->degree_v != n) return 0;
  return fs_stacho_side(n, 3);
}

/* value[order][width]: derivatives 0 .. 3 at t of a polynomial with coefficients c[degree + 1][width] */
static void differentiate(int32_t degree, int32_t width, const double *c, double t, double value[N_ORDERS][3]) {
  double basis[MAX_TERMS];
  for (int32_t order = 0; order < N_ORDERS; order++) {
    fs_bernstein_basis(degree, t, order, basis);
    for (int32_t w = 0; w < width; w++) value[order][w] = 0;
    for (int32_t i = 0; i <= degree; i++)
      for (int32_t w = 0; w < width; w++) value[order][w] += basis[i] * c[i * width + w];
  }
}

void fs_stacho_correction(const double *block, int32_t n, double t, double V[N_ORDERS][3]) {
  double delta[N_ORDERS][3], N[N_ORDERS][3], W[N_ORDERS][3] = {{0}}, q[N_ORDERS];
  differentiate(3 * n - 7, 1, block + FS_STACHO_DELTA, t, delta);
  differentiate(2 * n - 2, 3, block + fs_stacho_n(n), t, N);
  for (int w = 0; w < 3; w++) {
    W[0][w] = block[FS_STACHO_W + w];
    for (int m = 0; m < N_ORDERS && block[FS_STACHO_IS_FIXED] == 0; m++) W[m][w] = N[m][w];
  }
  for (int m = 0; m < N_ORDERS; m++) {
    q[m] = 0;
    for (int w = 0; w < 3; w++) V[m][w] = 0;
    for (int r = 0; r <= m; r++)
      for (int w = 0; w < 3; w++) {
        q[m] += binomial[m][r] * N[r][w] * W[m - r][w];
        V[m][w] -= binomial[m][r] * delta[r][0] * W[m - r][w];
      }
    for (int r = 1; r <= m; r++)
      for (int w = 0; w < 3; w++) V[m][w] -= binomial[m][r] * q[r] * V[m - r][w];
    for (int w = 0; w < 3; w++) V[m][w] /= q[0];
  }
}

/* d-th derivative of x^2, x^3 */
static double square(double x, int d) { return d == 0 ? x * x : d == 1 ? 2 * x : d == 2 ? 2 : 0; }
static double cube(double x, int d) { return d == 0 ? x * x * x : d == 1 ? 3 * x * x : d == 2 ? 6 * x : 6; }

/* f[3][FS_JET_SIZE]: derivatives by a and b of (1 - a - b) a^2 b^2 V((1 + a - b) / 2), component by component */
static void corrected_jet(const double *block, int32_t n, double a, double b, double f[3][FS_JET_SIZE]) {
  static const int8_t index[N_ORDERS][N_ORDERS] = {
      {FS_D, FS_DV, FS_DVV, FS_DVVV}, {FS_DU, FS_DUV, FS_DUVV}, {FS_DUU, FS_DUUV}, {FS_DUUU}};
  double V[N_ORDERS][3], bump[N_ORDERS][N_ORDERS];
  fs_stacho_correction(block, n, (1 + a - b) / 2, V);
  for (int p = 0; p < N_ORDERS; p++)
    for (int q = 0; p + q < N_ORDERS; q++)
      bump[p][q] = square(a, p) * square(b, q) - cube(a, p) * square(b, q) - square(a, p) * cube(b, q);
  for (int p = 0; p < N_ORDERS; p++)
    for (int q = 0; p + q < N_ORDERS; q++)
      for (int w = 0; w < 3; w++) {
        double sum = 0;
        for (int r = 0; r <= p; r++)
          for (int s = 0; s <= q; s++) { /* V differentiated r times by a and s times by b */
            double chain = (s % 2 ? -1.0 : 1.0) / (1 << (r + s));
            sum += binomial[p][r] * binomial[q][s] * bump[p - r][q - s] * chain * V[r + s][w];
          }
        f[w][index[p][q]] = sum;
      }
}

void fs_stacho_triangle_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x) {
  static const double none[2] = {0, 0};
  /* derivatives of (a, b) by u and by v, for each side */
  static const double by_u[3][2] = {{-1, 1}, {1, 0}, {0, -1}}, by_v[3][2] = {{-1, 0}, {0, 1}, {1, -1}};
  const double barycentric[4] = {1 - u - v, u, v, 1 - u - v};
  double f[3][FS_JET_SIZE];
  int32_t n = patch->degree_u;
  fs_bezier_triangle_jet(patch, data, u, v, x);
  if (fs_stacho_triangle_numbers(patch) == 0) return;
  for (int32_t s = 0; s < 3; s++) {
    const double *block = data + patch->data_start + fs_stacho_side(n, s);
    if (block[FS_STACHO_IS_CORRECTED] == 0) continue;
    corrected_jet(block, n, barycentric[s], barycentric[s + 1], f);
    for (int w = 0; w < 3; w++) fs_jet_compose(f[w], by_u[s], by_v[s], none, f[w]);
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = fs_vec3_add(x[k], (fs_vec3){f[0][k], f[1][k], f[2][k]});
  }
}
