/* SPDX-License-Identifier: MIT */
/* Single role: tables of basis derivatives at Gauss points, by the parameters and by the coordinates of the chart.

   With the chart d(u, v) = (x, y) and f(u, v) = g(d(u, v)) the chain rule is a 9x9 matrix T, block lower triangular:
     f_a   = sum g_i d^i_a
     f_ab  = sum g_i d^i_ab + sum g_ij d^i_a d^j_b
     f_abc = sum g_i d^i_abc + sum g_ij (d^i_ab d^j_c + d^i_ac d^j_b + d^i_bc d^j_a) + sum g_ijk d^i_a d^j_b d^k_c
   so that the derivatives by x and y are T^-1 times those by u and v. */
#include "space/basis.h"
#include "math/bernstein.h"
#include "math/quadrature.h"

#include <math.h>
#include <string.h>

enum { N = FS_N_DERIVATIVES, MAX_DEGREE = 16, MAX_NODES = 32 };

/* Orders by u and by v of the nine derivatives. */
static const int order_u[N] = {1, 0, 2, 1, 0, 3, 2, 1, 0}, order_v[N] = {0, 1, 0, 1, 2, 0, 1, 2, 3};

/* ---- derivatives by u and v -------------------------------------------------------------------------------------- */

typedef struct axis {
  double value[4][MAX_DEGREE + 1]; /* [order][function] of the Bernstein basis at one node */
} axis;

static void axis_fill(axis *a, int32_t degree, double t) {
  for (int order = 0; order < 4; order++) fs_bernstein_basis(degree, t, order, a->value[order]);
}

/* jet[9][n]: derivatives of n functions given by their Bezier coefficients, function innermost. */
static void tensor_jet(const fs_extraction *x, const double *bezier, int32_t n, const axis *u, const axis *v,
                       double *jet) {
  memset(jet, 0, (size_t)N * (size_t)n * sizeof *jet);
  for (int d = 0; d < N; d++)
    for (int j = 0; j <= x->degree_v; j++)
      for (int i = 0; i <= x->degree_u; i++) {
        double b = u->value[order_u[d]][i] * v->value[order_v[d]][j];
        const double *row = bezier + (size_t)(i + (x->degree_u + 1) * j) * n;
        for (int32_t k = 0; k < n; k++) jet[(size_t)d * n + k] += b * row[k];
      }
}

/* ---- the chart --------------------------------------------------------------------------------------------------- */

/* T from the derivatives d[9][2] of the chart. Rows by u, v; columns by x, y; both in the order of the nine. */
static void chain_matrix(const double *d, double T[N][N]) {
  /* row r differentiates by the parameters letter[r][..]; second[a][b]: number of the derivative by a and b */
  static const int letter[N][3] = {{0}, {1}, {0, 0}, {0, 1}, {1, 1}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  static const int n_letters[N] = {1, 1, 2, 2, 2, 3, 3, 3, 3}, second[2][2] = {{2, 3}, {3, 4}};
  memset(T, 0, N * N * sizeof T[0][0]);
  for (int r = 0; r < N; r++) {
    const int *s = letter[r];
    for (int i = 0; i < 2; i++) T[r][i] = d[2 * r + i];
    for (int i = 0; i < 2; i++)
      for (int j = 0; j < 2; j++) {
        double sum = 0;
        if (n_letters[r] == 2) sum = d[2 * s[0] + i] * d[2 * s[1] + j];
        if (n_letters[r] == 3)
          for (int c = 0; c < 3; c++) /* letter c alone, the two others together */
            sum += d[2 * second[s[(c + 1) % 3]][s[(c + 2) % 3]] + i] * d[2 * s[c] + j];
        T[r][second[i][j]] += sum;
      }
    if (n_letters[r] == 3)
      for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
          for (int k = 0; k < 2; k++) T[r][5 + i + j + k] += d[2 * s[0] + i] * d[2 * s[1] + j] * d[2 * s[2] + k];
  }
}

/* inverse = T^-1 by Gauss-Jordan elimination with row exchanges; false when T is singular. */
static bool invert_chain(double T[N][N], double inverse[N][N]) {
  for (int r = 0; r < N; r++)
    for (int c = 0; c < N; c++) inverse[r][c] = r == c;
  for (int c = 0; c < N; c++) {
    int best = c;
    for (int r = c + 1; r < N; r++)
      if (fabs(T[r][c]) > fabs(T[best][c])) best = r;
    if (!(fabs(T[best][c]) > 0)) return false;
    for (int k = 0; k < N && best != c; k++) {
      double swap = T[c][k];
      T[c][k] = T[best][k];
      T[best][k] = swap;
      swap = inverse[c][k];
      inverse[c][k] = inverse[best][k];
      inverse[best][k] = swap;
    }
    for (int r = 0; r < N; r++) {
      double factor = T[r][c] / T[c][c];
      if (r == c || factor == 0) continue;
      for (int k = 0; k < N; k++) {
        T[r][k] -= factor * T[c][k];
        inverse[r][k] -= factor * inverse[c][k];
      }
    }
  }
  for (int r = 0; r < N; r++)
    for (int k = 0; k < N; k++) inverse[r][k] /= T[r][r];
  return true;
}

/* ---- the table --------------------------------------------------------------------------------------------------- */

/* out[node][o][i], for an extraction that is the product of `segment` (4 x 4) with itself. */
static void fill_axis(const double *segment, int32_t n_nodes, const axis *node, double *out) {
  for (int32_t q = 0; q < n_nodes; q++)
    for (int o = 0; o < 4; o++)
      for (int i = 0; i < 4; i++, out++)
        for (int b = 0; b < 4; b++) *out += node[q].value[o][b] * segment[4 * b + i];
}

/* One point. Points beyond the last repeat it with weight 0, so that every lane sees a regular surface. */
static fs_status add_point(fs_context *ctx, fs_basis_table *table, const fs_extraction *x, int32_t point, const axis *u,
                           const axis *v, double weight, double *jet) {
  int32_t n = x->n_dofs, block = point / FS_POINT_BLOCK, lane = point % FS_POINT_BLOCK;
  double T[N][N], d[2 * N], inverse[N][N];
  tensor_jet(x, x->E, n, u, v, jet);
  table->weight[point] = weight;
  for (int e = 0; e < N; e++)
    for (int32_t k = 0; k < n; k++) {
      table->by_dof[(((size_t)block * N + e) * n + k) * FS_POINT_BLOCK + lane] = jet[(size_t)e * n + k];
      if (table->by_point != NULL)
        table->by_point[((size_t)point * N + e) * table->n_padded + k] = jet[(size_t)e * n + k];
    }
  if (x->chart == NULL) return FS_OK;
  tensor_jet(x, x->chart, 2, u, v, d);
  chain_matrix(d, T);
  if (!invert_chain(T, inverse))
    return fs_fail(ctx, FS_ERR_NUMERIC, "the chart of a cap of valence %d is singular", x->valence);
  table->chart_weight[point] = weight * fabs(d[0] * d[3] - d[1] * d[2]);
  for (int r = 0; r < N; r++)
    for (int c = 0; c < N; c++)
      table->inverse[(((size_t)block * N + r) * N + c) * FS_POINT_BLOCK + lane] = inverse[r][c];
  return FS_OK;
}

static fs_status allocate_arrays(fs_context *ctx, const fs_extraction *x, fs_basis_table *table) {
  fs_status status = FS_OK;
  size_t n_points = (size_t)table->n_blocks * FS_POINT_BLOCK;
  FS_ALLOC(ctx, table->weight, n_points);
  FS_ALLOC(ctx, table->by_dof, n_points * N * (size_t)table->n_dofs);
  if (x->segment != NULL)
    FS_ALLOC(ctx, table->axis, 16 * (size_t)table->n_nodes);
  else
    FS_ALLOC(ctx, table->by_point, n_points * N * (size_t)table->n_padded);
  if (x->chart != NULL) {
    FS_ALLOC(ctx, table->chart_weight, n_points);
    FS_ALLOC(ctx, table->inverse, n_points * N * N);
  }
done:
  return status;
}

fs_status fs_basis_create(fs_context *ctx, const fs_extraction *x, int32_t n_nodes, fs_basis_table **result) {
  fs_status status = FS_OK;
  fs_basis_table *table = NULL;
  axis *u = NULL, *v = NULL; /* [n_nodes] */
  double *jet = NULL, node[MAX_NODES], weight[MAX_NODES];
  if (n_nodes < 1 || n_nodes > MAX_NODES || x->degree_u > MAX_DEGREE || x->degree_v > MAX_DEGREE)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d quadrature nodes on degree (%d, %d): 1 to %d nodes are possible", n_nodes,
                   x->degree_u, x->degree_v, MAX_NODES);
  FS_ALLOC(ctx, table, 1);
  table->n_nodes = n_nodes;
  table->n_dofs = x->n_dofs;
  table->n_padded = (x->n_dofs + 7) / 8 * 8;
  table->n_blocks = (n_nodes * n_nodes + FS_POINT_BLOCK - 1) / FS_POINT_BLOCK;
  FS_TRY(allocate_arrays(ctx, x, table));
  FS_ALLOC(ctx, u, n_nodes);
  FS_ALLOC(ctx, v, n_nodes);
  FS_ALLOC(ctx, jet, (size_t)N * (size_t)x->n_dofs);
  FS_TRY(fs_gauss_legendre(ctx, n_nodes, node, weight));
  for (int32_t i = 0; i < n_nodes; i++) {
    axis_fill(&u[i], x->degree_u, node[i]);
    axis_fill(&v[i], x->degree_v, node[i]);
  }
  for (int32_t point = 0; point < table->n_blocks * FS_POINT_BLOCK; point++) {
    bool is_padding = point >= n_nodes * n_nodes;
    int32_t q = is_padding ? n_nodes * n_nodes - 1 : point;
    double w = is_padding ? 0.0 : weight[q % n_nodes] * weight[q / n_nodes];
    FS_TRY(add_point(ctx, table, x, point, &u[q % n_nodes], &v[q / n_nodes], w, jet));
  }
  if (x->segment != NULL) fill_axis(x->segment, n_nodes, u, table->axis);
  *result = table;
  table = NULL;
done:
  fs_release(ctx, u);
  fs_release(ctx, v);
  fs_release(ctx, jet);
  fs_basis_free(ctx, table);
  return status;
}

void fs_basis_free(fs_context *ctx, fs_basis_table *table) {
  if (table == NULL) return;
  fs_release(ctx, table->weight);
  fs_release(ctx, table->by_dof);
  fs_release(ctx, table->by_point);
  fs_release(ctx, table->chart_weight);
  fs_release(ctx, table->inverse);
  fs_release(ctx, table->axis);
  fs_release(ctx, table);
}
