/* SPDX-License-Identifier: MIT */
/* Single role: the densities of order 1 and 2: area, Willmore, thin plate. Points one by one: they cost little beside the
   chain rule.

     area        |n|, n = p_u x p_v
     willmore    H^2 |n| = A^2 / (4 W^(5/2)),  W = E G - F^2,  A = E N - 2 F M + G L  (L, M, N times |n|)
     thin plate  |p_uu|^2 + 2 |p_uv|^2 + |p_vv|^2 */
#include "fair/low_order.h"

#include <math.h>
#include <string.h>

enum { B = FS_BLOCK };
enum { U, V, UU, UV, VV };
enum { E, F, G, L, M, N };

static int pair_number(int i, int j, int n) { return i * n - i * (i - 1) / 2 + j - i; }

static void cross(const double *a, const double *b, double *out) {
  for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* p[n][3] of one point. */
static void gather(const double *x, int n, int lane, double (*p)[3]) {
  for (int i = 0; i < 3 * n; i++) p[i / 3][i % 3] = x[i * B + lane];
}

/* block[a][b] of a pair += scale times the matrix of dx . (dy x z): row x, column y. */
static void add_skew(double *ddf, int n, int x, int y, const double *z, double scale, int lane) {
  double s = x <= y ? scale : -scale, *b = ddf + (x <= y ? pair_number(x, y, n) : pair_number(y, x, n)) * 9 * B + lane;
  b[1 * B] += s * z[2];
  b[2 * B] -= s * z[1];
  b[3 * B] -= s * z[2];
  b[5 * B] += s * z[0];
  b[6 * B] += s * z[1];
  b[7 * B] -= s * z[0];
}

/* ---- thin plate ---- */

void fs_thin_plate(const double *x, double *f, double *df, double *ddf) {
  static const double weight[5] = {0, 0, 1, 2, 1};
  memset(f, 0, B * sizeof *f);
  if (ddf != NULL) memset(ddf, 0, 15 * 9 * B * sizeof *ddf);
  for (int i = 0; i < 5; i++)
    for (int a = 0; a < 3; a++)
      for (int l = 0; l < B; l++) {
        double y = x[(3 * i + a) * B + l];
        f[l] += weight[i] * y * y;
        if (df != NULL) df[(3 * i + a) * B + l] = 2 * weight[i] * y;
        if (ddf != NULL) ddf[(pair_number(i, i, 5) * 9 + 4 * a) * B + l] = 2 * weight[i];
      }
}

/* ---- area: f depends on n only; df = n0 . dn, d2f = dn^T (I - n0 n0^T) dn / |n| + n0 . d2n ---- */

void fs_area(const double *x, double *f, double *df, double *ddf) {
  for (int l = 0; l < B; l++) {
    double p[2][3], n[3], J[6][3]; /* J[3 i + a] = dn by component a of vector i */
    gather(x, 2, l, p);
    cross(p[U], p[V], n);
    f[l] = sqrt(dot(n, n));
    if (df == NULL) continue;
    for (int a = 0; a < 3; a++) {
      double e[3] = {a == 0, a == 1, a == 2};
      cross(e, p[V], J[a]);
      cross(p[U], e, J[3 + a]);
      n[a] /= f[l];
    }
    for (int i = 0; i < 6; i++) df[i * B + l] = dot(n, J[i]);
    if (ddf == NULL) continue;
    for (int i = 0; i < 6; i++)
      for (int j = 0; j < 6; j++)
        if (i / 3 <= j / 3)
          ddf[(pair_number(i / 3, j / 3, 2) * 9 + 3 * (i % 3) + j % 3) * B + l] =
              (dot(J[i], J[j]) - dot(n, J[i]) * dot(n, J[j])) / f[l];
    add_skew(ddf, 2, U, V, n, 1, l); /* n0 . (dp_u x dp_v) = dp_u . (dp_v x n0) */
  }
}

/* ---- Willmore ---- */

/* J[15][6] = ds/dy for s = (E, F, G, L, M, N), L = p_uu . (p_u x p_v), … */
static void jacobian(double (*p)[3], const double *n, double (*J)[6]) {
  memset(J, 0, 15 * sizeof *J);
  for (int a = 0; a < 3; a++) {
    J[3 * U + a][E] = 2 * p[U][a];
    J[3 * U + a][F] = p[V][a];
    J[3 * V + a][F] = p[U][a];
    J[3 * V + a][G] = 2 * p[V][a];
  }
  for (int k = 0; k < 3; k++) {
    double by_u[3], by_v[3];
    cross(p[V], p[UU + k], by_u);
    cross(p[UU + k], p[U], by_v);
    for (int a = 0; a < 3; a++) {
      J[3 * (UU + k) + a][L + k] = n[a];
      J[3 * U + a][L + k] = by_u[a];
      J[3 * V + a][L + k] = by_v[a];
    }
  }
}

/* Gradient and Hessian of f by s. */
static double outer_function(const double *s, double *g, double (*h)[6]) {
  double W = s[E] * s[G] - s[F] * s[F], A = s[E] * s[N] - 2 * s[F] * s[M] + s[G] * s[L];
  double c = 1 / (W * W * sqrt(W)), f = A * A * c / 4; /* c = W^(-5/2) */
  double f_A = A * c / 2, f_W = -2.5 * f / W, f_AA = c / 2, f_AW = -2.5 * f_A / W, f_WW = -3.5 * f_W / W;
  const double a[6] = {s[N], -2 * s[M], s[L], s[G], -2 * s[F], s[E]}, w[6] = {s[G], -2 * s[F], s[E], 0, 0, 0};
  for (int i = 0; i < 6; i++) {
    g[i] = f_A * a[i] + f_W * w[i];
    for (int j = 0; j < 6; j++) h[i][j] = f_AA * a[i] * a[j] + f_AW * (a[i] * w[j] + w[i] * a[j]) + f_WW * w[i] * w[j];
  }
  h[E][N] += f_A, h[N][E] += f_A;
  h[F][M] -= 2 * f_A, h[M][F] -= 2 * f_A;
  h[G][L] += f_A, h[L][G] += f_A;
  h[E][G] += f_W, h[G][E] += f_W;
  h[F][F] -= 2 * f_W;
  return f;
}

static void add_identity(double *ddf, int i, int j, double value, int lane) {
  for (int a = 0; a < 3; a++) ddf[(pair_number(i, j, 5) * 9 + 4 * a) * B + lane] += value;
}

static void second_derivatives(double (*p)[3], double (*J)[6], const double *g, double (*h)[6], double *ddf, int lane) {
  for (int i = 0; i < 15; i++) {
    double hJ[6];
    for (int r = 0; r < 6; r++) {
      hJ[r] = 0;
      for (int c = 0; c < 6; c++) hJ[r] += h[r][c] * J[i][c];
    }
    for (int j = 0; j < 15; j++) {
      double sum = 0;
      if (i / 3 > j / 3) continue;
      for (int r = 0; r < 6; r++) sum += hJ[r] * J[j][r];
      ddf[(pair_number(i / 3, j / 3, 5) * 9 + 3 * (i % 3) + j % 3) * B + lane] = sum;
    }
  }
  add_identity(ddf, U, U, 2 * g[E], lane);
  add_identity(ddf, U, V, g[F], lane);
  add_identity(ddf, V, V, 2 * g[G], lane);
  for (int k = 0; k < 3; k++) { /* x . (y x z) with x = p_uu, …, y = p_u, z = p_v */
    add_skew(ddf, 5, UU + k, U, p[V], g[L + k], lane);
    add_skew(ddf, 5, U, V, p[UU + k], g[L + k], lane);
    add_skew(ddf, 5, V, UU + k, p[U], g[L + k], lane);
  }
}

void fs_willmore(const double *x, double *f, double *df, double *ddf) {
  for (int l = 0; l < B; l++) {
    double p[5][3], n[3], s[6], g[6], h[6][6], J[15][6];
    gather(x, 5, l, p);
    cross(p[U], p[V], n);
    s[E] = dot(p[U], p[U]), s[F] = dot(p[U], p[V]), s[G] = dot(p[V], p[V]);
    for (int k = 0; k < 3; k++) s[L + k] = dot(p[UU + k], n);
    f[l] = outer_function(s, g, h);
    if (df == NULL) continue;
    jacobian(p, n, J);
    for (int i = 0; i < 15; i++) {
      double sum = 0;
      for (int r = 0; r < 6; r++) sum += g[r] * J[i][r];
      df[i * B + l] = sum;
    }
    if (ddf != NULL) second_derivatives(p, J, g, h, ddf, l);
  }
}
