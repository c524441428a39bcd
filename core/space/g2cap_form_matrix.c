/* SPDX-License-Identifier: MIT */
/* Single role: the energy, integral of |grad Laplace f|^2 over the plane domain of one sector, as a quadratic form of
   the 46 functions of the sector. [Kiciak 2013; docs/g2caps.md section 8]

     d(u,v)     chart                 plane domain of the sector, J = det(d_u, d_v) > 0
                X, Y                  d/dx = X0 d/du + X1 d/dv, d/dy = Y0 d/du + Y1 d/dv to leading order
     W          operator [2][9]       grad Laplace f = W (f_u, f_v, f_uu, f_uv, f_vv, f_uuu, f_uuv, f_uvv, f_vvv)

   W comes from the chain rule f_abc = (third derivatives of f by x, y) + (second) + (first), solved from the highest
   order down. An operator of order m is a homogeneous polynomial of degree m in the symbols d/dx, d/dy: a change to
   d/du, d/dv is a linear substitution. */
#include "space/g2cap_parts.h"
#include "math/bernstein.h"
#include "math/dense.h"
#include "math/quadrature.h"

#include <math.h>
#include <string.h>

enum {
  N = FS_G2CAP_DEGREE,
  ROWS = N + 1,
  OUTER = FS_G2CAP_OUTER,
  CHARTED = OUTER + 2, /* the outer functions and the two coordinates of the chart */
  LOCAL = FS_G2CAP_SECTOR,
  FIRST_INNER = 3, /* the inner functions have Bezier indices 3 .. 6 */
  DERIVATIVES = 9,
  DEFAULT_NODES = 32
};
enum { D_U, D_V, D_UU, D_UV, D_VV, D_UUU, D_UUV, D_UVV, D_VVV };
static const int32_t ORDER_U[DERIVATIVES] = {1, 0, 2, 1, 0, 3, 2, 1, 0},
                     ORDER_V[DERIVATIVES] = {0, 1, 0, 1, 2, 0, 1, 2, 3};

typedef double basis_jet[4][ROWS]; /* derivatives of order 0 .. 3 of the Bernstein basis at a node */

typedef struct workspace {
  int32_t n_nodes;
  double node[FS_GAUSS_MAX_NODES], weight[FS_GAUSS_MAX_NODES];
  basis_jet basis[FS_GAUSS_MAX_NODES];
  double patch[FS_G2CAP_POINTS][CHARTED];
  double column[4][ROWS][CHARTED];             /* contracted along u at one node: derivative in u, j, function */
  double line[2 * FS_GAUSS_MAX_NODES * LOCAL]; /* [node][2][46]: weighted grad Laplace along one line of nodes */
} workspace;

static fs_status set_nodes(fs_context *ctx, const fs_g2cap_options *options, workspace *work) {
  int32_t n = options->n_nodes == 0 ? DEFAULT_NODES : options->n_nodes, n_cells = options->composite ? n / 2 : 1;
  int32_t per_cell = options->composite ? 2 : n;
  fs_status status;
  if (n < 4 || n > FS_GAUSS_MAX_NODES || (options->composite && n % 2 != 0))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a cap needs 4 to %d quadrature nodes%s, not %d", FS_GAUSS_MAX_NODES,
                   options->composite ? ", an even number in cells of two" : "", n);
  status = fs_gauss_legendre(ctx, per_cell, work->node, work->weight);
  if (status != FS_OK) return status;
  for (int32_t i = n - 1; i >= 0; i--) { /* from the last, so that the first cell is overwritten last */
    work->node[i] = (i / per_cell + work->node[i % per_cell]) / n_cells;
    work->weight[i] = work->weight[i % per_cell] / n_cells;
  }
  work->n_nodes = n;
  for (int32_t i = 0; i < n; i++)
    for (int32_t order = 0; order < 4; order++) fs_bernstein_basis(N, work->node[i], order, work->basis[i][order]);
  return FS_OK;
}

/* column[p][j] = sum_i (B_i)^(p)(u) patch[i + 10 j] */
static void contract_u(basis_jet basis, workspace *work) {
  memset(work->column, 0, sizeof work->column);
  for (int32_t p = 0; p < 4; p++)
    for (int32_t j = 0; j < ROWS; j++)
      fs_dense_add_product(1, ROWS, CHARTED, 1, basis[p], ROWS, work->patch[ROWS * j], CHARTED, work->column[p][j],
                           CHARTED);
}

/* jet [9][32]: all derivatives of the functions and the chart at the node (u,v), column being that of u. */
static void contract_v(basis_jet basis, const workspace *work, double jet[DERIVATIVES][CHARTED]) {
  memset(jet, 0, DERIVATIVES * sizeof *jet);
  for (int32_t d = 0; d < DERIVATIVES; d++)
    fs_dense_add_product(1, ROWS, CHARTED, 1, basis[ORDER_V[d]], ROWS, work->column[ORDER_U[d]][0], CHARTED, jet[d],
                         CHARTED);
}

/* out += factor (p . symbol)(q . symbol) as coefficients of xx, xy, yy. */
static void add_symbols(double factor, const double p[2], const double q[2], double out[3]) {
  out[0] += factor * p[0] * q[0];
  out[1] += factor * (p[0] * q[1] + p[1] * q[0]);
  out[2] += factor * p[1] * q[1];
}

/* One row of W: the third-order operator with the coefficients third [4] of xxx, xxy, xyy, yyy. d are the derivatives
   of the chart. */
static void derive_operator(double d[DERIVATIVES][2], const double X[2], const double Y[2], const double third[4],
                            double row[DERIVATIVES]) {
  double *w1 = row, *w2 = row + D_UU, *w3 = row + D_UUU, second[3] = {0}, first[2] = {0};
  fs_g2cap_substitute(3, third, X, Y, w3);
  /* What w3 brings along in second derivatives: f_abc has f_ij (d^i_ab d^j_c + d^i_ac d^j_b + d^i_bc d^j_a). */
  add_symbols(3 * w3[0], d[D_UU], d[D_U], second);
  add_symbols(w3[1], d[D_UU], d[D_V], second);
  add_symbols(2 * w3[1], d[D_UV], d[D_U], second);
  add_symbols(2 * w3[2], d[D_UV], d[D_V], second);
  add_symbols(w3[2], d[D_VV], d[D_U], second);
  add_symbols(3 * w3[3], d[D_VV], d[D_V], second);
  fs_g2cap_substitute(2, second, X, Y, w2);
  for (int32_t i = 0; i < 3; i++) w2[i] = -w2[i];
  /* And what both bring in first derivatives. */
  for (int32_t i = D_UU; i <= D_VVV; i++)
    for (int32_t x = 0; x < 2; x++) first[x] += row[i] * d[i][x];
  fs_g2cap_substitute(1, first, X, Y, w1);
  for (int32_t i = 0; i < 2; i++) w1[i] = -w1[i];
}

/* gradient [2][46] = sqrt(weight J) grad Laplace of all functions at a node; false where J is not positive. */
static bool derive_gradient(basis_jet basis_u, basis_jet basis_v, double jet[DERIVATIVES][CHARTED], double weight,
                            double (*gradient)[LOCAL]) {
  static const double LAPLACE_X[4] = {1, 0, 1, 0}, LAPLACE_Y[4] = {0, 1, 0, 1};
  double d[DERIVATIVES][2], W[2][DERIVATIVES], determinant;
  for (int32_t i = 0; i < DERIVATIVES; i++) memcpy(d[i], jet[i] + OUTER, sizeof d[i]);
  determinant = d[D_U][0] * d[D_V][1] - d[D_U][1] * d[D_V][0];
  if (!(determinant > 0)) return false;
  const double X[2] = {d[D_V][1] / determinant, -d[D_U][1] / determinant};
  const double Y[2] = {-d[D_V][0] / determinant, d[D_U][0] / determinant};
  derive_operator(d, X, Y, LAPLACE_X, W[0]);
  derive_operator(d, X, Y, LAPLACE_Y, W[1]);
  for (int32_t x = 0; x < 2; x++) {
    double *out = gradient[x];
    memset(out, 0, LOCAL * sizeof *out);
    for (int32_t i = 0; i < DERIVATIVES; i++) W[x][i] *= sqrt(weight * determinant);
    fs_dense_add_product(1, DERIVATIVES, OUTER, 1, W[x], DERIVATIVES, jet[0], CHARTED, out, LOCAL);
    for (int32_t b = 0; b < 4; b++)
      for (int32_t a = 0; a < 4; a++)
        for (int32_t i = 0; i < DERIVATIVES; i++)
          out[OUTER + a + 4 * b] +=
              W[x][i] * basis_u[ORDER_U[i]][FIRST_INNER + a] * basis_v[ORDER_V[i]][FIRST_INNER + b];
  }
  return true;
}

static void join_patches(const double *local, const double *chart, workspace *work) {
  for (int32_t point = 0; point < FS_G2CAP_POINTS; point++) {
    memcpy(work->patch[point], local + OUTER * point, OUTER * sizeof(double));
    memcpy(work->patch[point] + OUTER, chart + 2 * point, 2 * sizeof(double));
  }
}

fs_status fs_g2cap_form_matrix(fs_context *ctx, const fs_g2cap_options *options, const double *local,
                               const double *chart, double *form) {
  fs_status status = FS_OK;
  workspace *work = NULL;
  FS_ALLOC(ctx, work, 1);
  FS_TRY(set_nodes(ctx, options, work));
  join_patches(local, chart, work);
  memset(form, 0, (size_t)(LOCAL * LOCAL) * sizeof *form);
  for (int32_t i = 0; i < work->n_nodes; i++) {
    contract_u(work->basis[i], work);
    for (int32_t j = 0; j < work->n_nodes; j++) {
      double jet[DERIVATIVES][CHARTED];
      contract_v(work->basis[j], work, jet);
      if (!derive_gradient(work->basis[i], work->basis[j], jet, work->weight[i] * work->weight[j],
                           (double(*)[LOCAL])(work->line + 2 * j * LOCAL))) {
        status = fs_fail(ctx, FS_ERR_NUMERIC, "the plane domain of a cap is folded at (%g, %g)", work->node[i],
                         work->node[j]);
        goto done;
      }
    }
    fs_dense_add_gram(2 * work->n_nodes, LOCAL, work->line, LOCAL, 1, form, LOCAL);
  }
  fs_dense_mirror(LOCAL, form, LOCAL);
done:
  fs_release(ctx, work);
  return status;
}

fs_status fs_g2cap_area(fs_context *ctx, const double *chart, double *area) {
  enum { EXACT = 9 }; /* J has degree 17 in u and in v */
  double node[EXACT], weight[EXACT], sum = 0;
  fs_status status = fs_gauss_legendre(ctx, EXACT, node, weight);
  if (status != FS_OK) return status;
  for (int32_t i = 0; i < EXACT; i++)
    for (int32_t j = 0; j < EXACT; j++) {
      double u[2][ROWS], v[2][ROWS], d[2][2] = {{0}};
      for (int32_t order = 0; order < 2; order++) {
        fs_bernstein_basis(N, node[i], order, u[order]);
        fs_bernstein_basis(N, node[j], order, v[order]);
      }
      for (int32_t point = 0; point < FS_G2CAP_POINTS; point++)
        for (int32_t x = 0; x < 2; x++) {
          d[0][x] += u[1][point % ROWS] * v[0][point / ROWS] * chart[2 * point + x];
          d[1][x] += u[0][point % ROWS] * v[1][point / ROWS] * chart[2 * point + x];
        }
      sum += weight[i] * weight[j] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
    }
  *area = sum;
  return FS_OK;
}
