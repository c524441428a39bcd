/* SPDX-License-Identifier: MIT */
/* Single role: one triangle of Stacho from the data of its corners, as Bernstein coefficients.

     Phi(t) = t^3 (10 - 15 t + 6 t^2),  Theta(t) = t^3 (4 - 3 t),  Theta' = 12 t^2 (1 - t)
     L_i = p_i + l_j g_ij + l_k g_ik,   Q_i = L_i + (h^i_jj l_j^2 + 2 h^i_jk l_j l_k + h^i_kk l_k^2) / 2
     quintic       F = sum_i Phi(l_i) p_i + Theta(l_i) (l_j g_ij + l_k g_ik) + sum_k l_k l_i^2 l_j^2 zeta_k,
                   zeta_k = 30 (alpha_k p_i + (1 - alpha_k) p_j) + 12 (alpha_k g_ij + (1 - alpha_k) g_ji)
     first order   F = sum_i Phi(l_i) L_i + 30 sum_k l_k l_i^2 l_j^2 (alpha_k L_i + (1 - alpha_k) L_j)
     second order  the same with Q_i
   [Stacho 2019; Stacho 2025]. Differs: the source prints Theta = t^2 (4 - 3 t), whose derivative at 1 is not 0, and zeta_k
   with the sign of g_ji turned round, which is not C1; its first order keeps in the last sum only the part of L_i along
   the edge, which does not reproduce affine functions; the second order is an extension. */
#include "construct/stacho.h"
#include "math/bernstein.h"
#include "math/triangle.h"

#include <math.h>
#include <string.h>

enum { BUMP_DEGREE = 5, MAX_POINTS = (FS_MAX_TRIANGLE_DEGREE + 1) * (FS_MAX_TRIANGLE_DEGREE + 2) / 2 };

static const double phi[6] = {0, 0, 0, 1, 1, 1}, theta[5] = {0, 0, 0, 1, 1};

/* 30 t1^2 t2^2 t3 and 12 t1^2 t2^2 t3: one coefficient, that of exponents (2, 2, 1), number 8 */
static const double bump_30[21] = {[8] = 1}, bump_12[21] = {[8] = 0.4};

const fs_stacho_shape fs_stacho_quintic = {{5, 4}, {5, 5}, {phi, theta}, {bump_30, bump_12}};

int32_t fs_stacho_degree(fs_stacho_variant variant) {
  return variant == FS_STACHO_QUINTIC ? 5 : variant == FS_STACHO_FIRST_ORDER ? 6 : 7;
}

static void set(int32_t width, double *to, const double *from, double factor) {
  for (int32_t w = 0; w < width; w++) to[w] = factor * from[w];
}

static void add(int32_t width, double *to, const double *from, double factor) {
  for (int32_t w = 0; w < width; w++) to[w] += factor * from[w];
}

/* Number of the coefficient of degree 2 (or 1, where b is none) whose exponents count the corners a and b. */
static int32_t at(int a, int b) {
  int32_t e[3] = {0, 0, 0};
  e[a]++;
  if (b >= 0) e[b]++;
  return fs_triangle_at(e);
}

/* L_i (degree 1) or Q_i (degree 2) as coefficients. */
static void set_taylor(const fs_stacho_corners *c, int i, int32_t degree, double *q) {
  int32_t width = c->width;
  for (int a = 0; a < 3; a++)
    for (int b = degree == 1 ? a : 0; b <= a; b++) {
      double *to = q + width * (degree == 1 ? at(a, -1) : at(a, b));
      set(width, to, c->p[i], 1);
      if (a != i) add(width, to, c->g[i][a], 1.0 / degree);
      if (degree == 1) continue;
      if (b != i) add(width, to, c->g[i][b], 0.5);
      if (a != i && b != i) add(width, to, c->h[i][a][b], 0.5);
    }
}

/* Exponents 2, 2, 1 of the term of edge k. */
static void set_bump(int k, double *bump) {
  int32_t e[3] = {2, 2, 2};
  e[k] = 1;
  memset(bump, 0, 21 * sizeof *bump);
  bump[fs_triangle_at(e)] = 1;
}

/* First and second order: products of degree 5 with L_i or Q_i of degree m. */
static void set_taylor_bezier(const fs_stacho_corners *corners, int32_t m, double *c) {
  double q[3][6 * 3], mixed[6 * 3], scalar[21];
  int32_t width = corners->width, size = fs_triangle_size(m);
  memset(c, 0, (size_t)(fs_triangle_size(BUMP_DEGREE + m) * width) * sizeof *c);
  for (int i = 0; i < 3; i++) {
    set_taylor(corners, i, m, q[i]);
    fs_triangle_of_coordinate(BUMP_DEGREE, phi, i, scalar);
    fs_triangle_add_product(BUMP_DEGREE, scalar, m, width, q[i], c);
  }
  for (int k = 0; k < 3; k++) {
    set(size * width, mixed, q[(k + 1) % 3], corners->alpha[k]);
    add(size * width, mixed, q[(k + 2) % 3], 1 - corners->alpha[k]);
    set_bump(k, scalar);
    fs_triangle_add_product(BUMP_DEGREE, scalar, m, width, mixed, c);
  }
}

void fs_stacho_bezier(const fs_stacho_corners *corners, fs_stacho_variant variant, double *c) {
  if (variant == FS_STACHO_QUINTIC)
    fs_stacho_shaped_bezier(corners, &fs_stacho_quintic, c);
  else
    set_taylor_bezier(corners, variant == FS_STACHO_FIRST_ORDER ? 1 : 2, c);
}

int32_t fs_stacho_shape_degree(const fs_stacho_shape *shape) {
  int32_t degree = shape->psi_degree[1] + 1;
  if (shape->psi_degree[0] > degree) degree = shape->psi_degree[0];
  for (int s = 0; s < 2; s++)
    if (shape->chi_degree[s] > degree) degree = shape->chi_degree[s];
  return degree;
}

/* c += f b, f of degree n, b of degree m, written with degree to. */
static void add_raised(int32_t n, const double *f, int32_t m, int32_t width, const double *b, int32_t to, double *c) {
  double raised[MAX_POINTS];
  fs_triangle_elevate(n, 1, f, to - m, raised);
  fs_triangle_add_product(to - m, raised, m, width, b, c);
}

/* chi(l_first, l_second, l_k) over the triangle */
static void place_chi(int32_t degree, const double *chi, int first, int second, int k, double *placed) {
  for (int32_t e3 = 0; e3 <= degree; e3++)
    for (int32_t e2 = 0; e2 <= degree - e3; e2++) {
      int32_t e[3];
      e[first] = degree - e2 - e3, e[second] = e2, e[k] = e3;
      placed[fs_triangle_at(e)] = chi[fs_triangle_index(degree, e2, e3)];
    }
}

void fs_stacho_shaped_bezier(const fs_stacho_corners *corners, const fs_stacho_shape *shape, double *c) {
  double scalar[MAX_POINTS], linear[9];
  int32_t width = corners->width, degree = fs_stacho_shape_degree(shape);
  memset(c, 0, (size_t)(fs_triangle_size(degree) * width) * sizeof *c);
  for (int i = 0; i < 3; i++) {
    fs_triangle_of_coordinate(shape->psi_degree[0], shape->psi[0], i, scalar);
    add_raised(shape->psi_degree[0], scalar, 0, width, corners->p[i], degree, c);
    for (int a = 0; a < 3; a++) set(width, linear + a * width, corners->g[i][a], a == i ? 0 : 1);
    fs_triangle_of_coordinate(shape->psi_degree[1], shape->psi[1], i, scalar);
    add_raised(shape->psi_degree[1], scalar, 1, width, linear, degree, c);
  }
  for (int k = 0; k < 3; k++)
    for (int end = 0; end < 2; end++) {
      int i = (k + 1 + end) % 3, j = (k + 2 - end) % 3;
      double weight = end == 0 ? corners->alpha[k] : 1 - corners->alpha[k], data[2][3];
      set(width, data[0], corners->p[i], weight);
      set(width, data[1], corners->g[i][j], weight);
      for (int s = 0; s < 2; s++) {
        place_chi(shape->chi_degree[s], shape->chi[s], i, j, k, scalar);
        add_raised(shape->chi_degree[s], scalar, 0, width, data[s], degree, c);
      }
    }
}

/* ---- conditions ---- */

static double largest(int32_t n, const double *a) {
  double value = 0;
  for (int32_t i = 0; i < n; i++) value = fmax(value, fabs(a[i]));
  return value;
}

static fs_status check_psi(fs_context *ctx, int s, int32_t n, const double *psi) {
  double near = 1e-12 * (1 + largest(n + 1, psi));
  if (!(fabs(psi[0]) <= near)) return fs_fail(ctx, FS_ERR_ARGUMENT, "psi_%d(0) is %g instead of 0", s, psi[0]);
  if (!(fabs(psi[n] - 1) <= near)) return fs_fail(ctx, FS_ERR_ARGUMENT, "psi_%d(1) is %g instead of 1", s, psi[n]);
  if (!(fabs(psi[1] - psi[0]) <= near))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "psi_%d'(0) is %g instead of 0", s, n * (psi[1] - psi[0]));
  if (s == 0 && !(fabs(psi[n] - psi[n - 1]) <= near))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "psi_0'(1) is %g instead of 0", n * (psi[n] - psi[n - 1]));
  return FS_OK;
}

/* The coefficients that vanish with chi on the edges, and with its first derivatives on two of them. */
static fs_status check_chi(fs_context *ctx, int s, int32_t n, const double *chi) {
  double near = 1e-12 * (1 + largest(fs_triangle_size(n), chi));
  for (int32_t e3 = 0; e3 <= n; e3++)
    for (int32_t e2 = 0; e2 <= n - e3; e2++) {
      int32_t e1 = n - e2 - e3;
      double value = chi[fs_triangle_index(n, e2, e3)];
      if ((e1 < 2 || e2 < 2 || e3 < 1) && !(fabs(value) <= near))
        return fs_fail(
            ctx, FS_ERR_ARGUMENT,
            "chi_%d has the coefficient %g at exponents (%d, %d, %d), where it must vanish to keep the edges", s, value,
            (int)e1, (int)e2, (int)e3);
    }
  return FS_OK;
}

/* d chi / d l_k on the edge against psi_0' or (1 - t) psi_1', both with degree 2 FS_MAX_TRIANGLE_DEGREE. */
static fs_status check_pair(fs_context *ctx, const fs_stacho_shape *shape, int s) {
  enum { MAX = 2 * FS_MAX_TRIANGLE_DEGREE };
  static const double falling[2] = {1, 0};
  double across[MAX + 1], along[MAX + 1], wanted[MAX + 1] = {0}, raised[2][MAX + 1];
  int32_t n = shape->chi_degree[s], m = shape->psi_degree[s], degree = m - 1 + s;
  for (int32_t e1 = 0; e1 < n; e1++) across[e1] = n * shape->chi[s][fs_triangle_index(n, n - 1 - e1, 1)];
  fs_bernstein_differentiate(m, 1, shape->psi[s], along);
  if (s == 0)
    memcpy(wanted, along, (size_t)m * sizeof *along);
  else
    fs_bernstein_add_product(1, falling, m - 1, 1, along, wanted);
  fs_bernstein_elevate(n - 1, 1, across, MAX, raised[0]);
  fs_bernstein_elevate(degree, 1, wanted, MAX, raised[1]);
  for (int32_t i = 0; i <= MAX; i++)
    if (!(fabs(raised[0][i] - raised[1][i]) <= 1e-12 * (1 + largest(MAX + 1, raised[1])))) {
      double basis[MAX + 1], is = 0, should_be = 0, t = (double)i / MAX;
      fs_bernstein_basis(MAX, t, 0, basis);
      for (int32_t r = 0; r <= MAX; r++) is += basis[r] * raised[0][r], should_be += basis[r] * raised[1][r];
      return fs_fail(ctx, FS_ERR_ARGUMENT,
                     "the derivative of chi_%d across its edge does not match psi_%d: near t = %g "
                     "it is %g instead of %g",
                     s, s, t, is, should_be);
    }
  return FS_OK;
}

fs_status fs_stacho_shape_check(fs_context *ctx, const fs_stacho_shape *shape) {
  fs_status status = FS_OK;
  for (int s = 0; s < 2; s++) {
    int32_t n = shape->chi_degree[s], m = shape->psi_degree[s];
    if (n < 1 || m < 1 || n >= FS_MAX_TRIANGLE_DEGREE || m >= FS_MAX_TRIANGLE_DEGREE)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "psi_%d and chi_%d have degrees %d and %d, which are not between 1 and %d",
                     s, s, (int)m, (int)n, FS_MAX_TRIANGLE_DEGREE - 1);
    FS_TRY(check_psi(ctx, s, m, shape->psi[s]));
    FS_TRY(check_chi(ctx, s, n, shape->chi[s]));
  }
  for (int s = 0; s < 2; s++) FS_TRY(check_pair(ctx, shape, s));
done:
  return status;
}
