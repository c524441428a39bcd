/* SPDX-License-Identifier: MIT */
/* Coons patches: interpolate curves and derivatives across them on all four sides, by a Boolean sum [Coons 1967],
     S = sum_a beta_a(u) L_a(v) + sum_b beta_b(v) M_b(u) - sum_ab beta_a(u) beta_b(v) Q_ab,
   L = at_u, M = at_v, Q_ab what both are where their sides meet. This file: the blending functions beta, whether the data
   agree, and values. The derivative of order (p, q) has those of order p of the functions of u, q of v.

   With twists that differ, g' by the side u = i and e' by v = j, Gregory's square uses (x g' + y e') / (x + y) at a corner,
   x and y the distances from it [Gregory 1974]. As T = g' + y / (x + y) (e' - g') and beta_(0,1) = x (1 - x)^2, the second
   part adds -+(1 - x)^2 (1 - y)^2 phi(y, x) (e' - g') with phi of surface/gregory.h. */
#include "construct/coons.h"
#include "math/bernstein.h"
#include "math/vec3.h"
#include "surface/gregory.h"

#include <stdio.h>

/* ---- blending functions ---- */

int32_t fs_coons_blend_degree(const fs_coons_data *data) {
  return data->n_data == 2 && data->blend_degree > 0 ? data->blend_degree : data->n_data - 1;
}

const double *fs_coons_blend(const fs_coons_data *data, int32_t a) {
  static const double linear[2][2] = {{1, 0}, {0, 1}};
  static const double cubic[4][4] = {{1, 1, 0, 0}, {0, 0, 1, 1}, {0, 1.0 / 3, 0, 0}, {0, 0, -1.0 / 3, 0}};
  static const double quintic[6][6] = {{1, 1, 1, 0, 0, 0},       {0, 0, 0, 1, 1, 1},    {0, 0.2, 0.4, 0, 0, 0},
                                       {0, 0, 0, -0.4, -0.2, 0}, {0, 0, 0.05, 0, 0, 0}, {0, 0, 0, 0.05, 0, 0}};
  if (data->n_data == 2) return data->blend_degree > 0 ? data->blend[a] : linear[a];
  return data->n_data == 4 ? cubic[a] : quintic[a];
}

static fs_status check_blend(fs_context *ctx, const fs_coons_data *data) {
  int32_t n = data->blend_degree;
  if (data->n_data != 2 || n == 0) return FS_OK;
  if (n < 0 || n > FS_MAX_DEGREE || data->blend[0] == NULL || data->blend[1] == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "blending functions cannot have degree %d", (int)n);
  for (int32_t i = 0; i < 2; i++)
    for (int32_t at = 0; at < 2; at++) {
      double value = data->blend[i][at == 0 ? 0 : n], due = at == i;
      if (!(fabs(value - due) <= 1e-12))
        return fs_fail(ctx, FS_ERR_ARGUMENT, "blending function %d is %g at %d, not %g", (int)i, value, (int)at, due);
    }
  for (int32_t k = 0; k <= n; k++)
    if (!(fabs(data->blend[0][k] + data->blend[1][k] - 1) <= 1e-12))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the blending functions do not sum to 1: coefficients %d sum to %g", (int)k,
                     data->blend[0][k] + data->blend[1][k]);
  return FS_OK;
}

/* ---- agreement at corners ---- */

/* The size of the sides: the diagonal of the box of some of their points. */
static double size_of(const fs_coons_data *data) {
  enum { N = 8 };
  fs_vec3 min = {INFINITY, INFINITY, INFINITY}, max = {-INFINITY, -INFINITY, -INFINITY}, x[4];
  for (int32_t k = 0; k < 4 * (N + 1); k++) {
    const fs_curve *curve = k % 2 == 0 ? &data->at_u[k / 2 % 2] : &data->at_v[k / 2 % 2];
    curve->evaluate(curve->user, (double)(k / 4) / N, x);
    min = fs_vec3_min(min, x[0]);
    max = fs_vec3_max(max, x[0]);
  }
  return fs_vec3_distance(min, max);
}

/* "S_uuv" for k = 2, l = 1 */
static void name_derivative(int32_t k, int32_t l, char name[8]) {
  int32_t n = 0;
  name[n++] = 'S';
  if (k + l > 0) name[n++] = '_';
  for (int32_t i = 0; i < k; i++) name[n++] = 'u';
  for (int32_t i = 0; i < l; i++) name[n++] = 'v';
  name[n] = '\0';
}

static fs_status check_corner(fs_context *ctx, int32_t a, int32_t b, fs_vec3 by_u, fs_vec3 by_v, double allowed) {
  double gap = fs_vec3_distance(by_u, by_v);
  char name[8];
  if (gap <= allowed) return FS_OK;
  name_derivative(fs_coons_order(a), fs_coons_order(b), name);
  return fs_fail(ctx, FS_ERR_NUMERIC, "the sides u = %d and v = %d differ at (%d, %d) by %.3g in %s",
                 (int)fs_coons_side(a), (int)fs_coons_side(b), (int)fs_coons_side(a), (int)fs_coons_side(b), gap, name);
}

fs_status fs_coons_prepare(fs_context *ctx, const fs_coons_data *data, double tolerance, fs_coons *coons) {
  fs_status status = FS_OK;
  int32_t n = data->n_data;
  fs_coons made = {.data = *data};
  fs_vec3 by_v[FS_COONS_MOST][FS_COONS_MOST], x[4];
  double size, largest = 0;
  if (n != 2 && n != 4 && n != 6)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a Coons patch has 2, 4 or 6 data per direction, not %d", (int)n);
  if (data->is_gregory && n != 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "Gregory's square has 4 data per direction, not %d", (int)n);
  FS_TRY(check_blend(ctx, data));
  for (int32_t a = 0; a < n; a++)
    for (int32_t b = 0; b < n; b++) {
      data->at_u[a].evaluate(data->at_u[a].user, fs_coons_side(b), x);
      made.corner[a][b] = x[fs_coons_order(b)];
      data->at_v[b].evaluate(data->at_v[b].user, fs_coons_side(a), x);
      by_v[a][b] = x[fs_coons_order(a)];
      if (fs_coons_order(a) + fs_coons_order(b) == 0) continue;
      largest = fmax(largest, fmax(fs_vec3_length(made.corner[a][b]), fs_vec3_length(by_v[a][b])));
    }
  size = size_of(data);
  for (int32_t order = 0; order <= 4; order++) /* positions first */
    for (int32_t a = 0; a < n; a++)
      for (int32_t b = 0; b < n; b++) {
        bool is_twist = fs_coons_order(a) == 1 && fs_coons_order(b) == 1;
        if (fs_coons_order(a) + fs_coons_order(b) != order || (is_twist && data->is_gregory)) continue;
        FS_TRY(check_corner(ctx, a, b, made.corner[a][b], by_v[a][b], tolerance * (order == 0 ? size : largest)));
      }
  for (int32_t i = 0; i < 2 && data->is_gregory; i++)
    for (int32_t j = 0; j < 2; j++) made.twist_gap[i][j] = fs_vec3_sub(by_v[2 + i][2 + j], made.corner[2 + i][2 + j]);
  *coons = made;
done:
  return status;
}

/* ---- values ---- */

/* value[a][order]: derivatives 0 .. 3 of the blending functions. */
static void blend_at(const fs_coons_data *data, double t, double value[FS_COONS_MOST][4]) {
  int32_t degree = fs_coons_blend_degree(data);
  double basis[FS_MAX_DEGREE + 1];
  for (int32_t order = 0; order < 4; order++) {
    fs_bernstein_basis(degree, t, order, basis);
    for (int32_t a = 0; a < data->n_data; a++) {
      const double *blend = fs_coons_blend(data, a);
      value[a][order] = 0;
      for (int32_t k = 0; k <= degree; k++) value[a][order] += blend[k] * basis[k];
    }
  }
}

/* -+(1 - x)^2 (1 - y)^2 phi(y, x) gap, with its derivatives by u and v, for one corner. */
static void add_square(fs_vec3 gap, double x, double sx, double y, double sy, fs_vec3 *out) {
  static const uint8_t order_u[FS_JET_SIZE] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  static const uint8_t order_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};
  static const uint8_t place[4][4] = {
      {FS_D, FS_DV, FS_DVV, FS_DVVV}, {FS_DU, FS_DUV, FS_DUVV, 0}, {FS_DUU, FS_DUUV, 0, 0}, {FS_DUUU, 0, 0, 0}};
  static const double binomial[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  const double f[4] = {(1 - x) * (1 - x), -2 * (1 - x), 2, 0}, g[4] = {(1 - y) * (1 - y), -2 * (1 - y), 2, 0};
  double phi[FS_JET_SIZE]; /* by (y, x) */
  if (fs_vec3_dot(gap, gap) == 0) return;
  fs_gregory_phi(y, x, phi);
  for (int k = 0; k < FS_JET_SIZE; k++) {
    int p = order_u[k], q = order_v[k];
    double sum = 0, sign = -sx * sy * (p % 2 ? sx : 1) * (q % 2 ? sy : 1);
    for (int a = 0; a <= p; a++)
      for (int b = 0; b <= q; b++) sum += binomial[p][a] * binomial[q][b] * f[p - a] * g[q - b] * phi[place[b][a]];
    out[k] = fs_vec3_add_scaled(out[k], gap, sign * sum);
  }
}

void fs_coons_evaluate(const fs_coons *coons, double u, double v, fs_vec3 *x) {
  static const uint8_t order_u[FS_JET_SIZE] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  static const uint8_t order_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};
  const fs_coons_data *data = &coons->data;
  double beta_u[FS_COONS_MOST][4], beta_v[FS_COONS_MOST][4];
  fs_vec3 L[FS_COONS_MOST][4], M[FS_COONS_MOST][4];
  blend_at(data, u, beta_u);
  blend_at(data, v, beta_v);
  for (int32_t a = 0; a < data->n_data; a++) {
    data->at_u[a].evaluate(data->at_u[a].user, v, L[a]);
    data->at_v[a].evaluate(data->at_v[a].user, u, M[a]);
  }
  for (int k = 0; k < FS_JET_SIZE; k++) {
    int p = order_u[k], q = order_v[k];
    x[k] = (fs_vec3){0, 0, 0};
    for (int32_t a = 0; a < data->n_data; a++) {
      fs_vec3 inner = L[a][q];
      for (int32_t b = 0; b < data->n_data; b++) inner = fs_vec3_add_scaled(inner, coons->corner[a][b], -beta_v[b][q]);
      x[k] = fs_vec3_add_scaled(x[k], inner, beta_u[a][p]);
      x[k] = fs_vec3_add_scaled(x[k], M[a][p], beta_v[a][q]);
    }
  }
  if (!data->is_gregory) return;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      add_square(coons->twist_gap[i][j], i ? 1 - u : u, i ? -1 : 1, j ? 1 - v : v, j ? -1 : 1, x);
}
