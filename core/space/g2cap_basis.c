/* SPDX-License-Identifier: MIT */
/* Single role: the functions of which a cap is made. [Kiciak 2013; docs/g2caps.md section 7]

   In one sector a function is determined by 30 numbers: its values at 15 vertices, and the polynomial z(x,y) of degree
   4 that it follows at the centre, as 15 coefficients in the frame of the sector (x along its spoke). z gives the
   centre jets of both spokes: with z_d the part of degree d and z_d(x e + y n) = sum_n a_n x^(d-n) y^n,

     d^(d-n)_u d^n_s r = (d-n)! n! a_n,  n <= 2

   The functions phi vanish on the ring. They are the 15 monomials, and the splines of degree d = 3 and 4 over the fan
   of spokes. A spline changes by c_i l_i^3 (d = 3) or l_i^3 (c_i m_i + c'_i l_i) (d = 4) at spoke i, with

     l_i = -sin t_i x + cos t_i y,  m_i = cos t_i x + sin t_i y,  t_i = 2 pi i/k,

   and c is such that all changes add up to 0: an orthonormal basis of that null space is taken, the only one whose
   leading square block is upper triangular with positive diagonal. Coefficients of inner functions, once written to a
   file, must mean the same functions everywhere.                                                                    */
#include "space/g2cap_parts.h"
#include "math/bernstein.h"
#include "math/dense.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static const double FACTORIAL[5] = {1, 1, 2, 6, 24};

/* centre [3][5][30]: jets at the centre, along a spoke with the directions e and n, of the 30 functions. */
static void set_centre_jets(const double e[2], const double n[2], double (*centre)[5][FS_G2CAP_OUTER]) {
  const double X[2] = {e[0], n[0]}, Y[2] = {e[1], n[1]};
  memset(centre, 0, 3 * sizeof *centre);
  for (int32_t d = 0; d <= 4; d++)
    for (int32_t j = 0; j <= d; j++) {
      double monomial[5] = {0}, a[5];
      monomial[j] = 1;
      fs_g2cap_substitute(d, monomial, X, Y, a);
      for (int32_t i = 0; i <= d && i <= 2; i++)
        centre[i][d - i][FS_G2CAP_VERTICES + fs_g2cap_monomial(d, j)] = FACTORIAL[d - i] * FACTORIAL[i] * a[i];
    }
}

typedef struct workspace {
  double grid[FS_G2CAP_VERTICES][FS_G2CAP_OUTER]; /* vertex values of the 30 functions */
  double centre[3][5][FS_G2CAP_OUTER], end[3][3][FS_G2CAP_OUTER];
  fs_g2cap_curves side[4];
} workspace;

fs_status fs_g2cap_local_patches(fs_context *ctx, const fs_g2cap_domain *domain, const fs_g2cap_junction *junction,
                                 double *local, double *chart) {
  fs_status status = FS_OK;
  workspace *work = NULL;
  FS_ALLOC(ctx, work, 1);
  for (int32_t v = 0; v < FS_G2CAP_VERTICES; v++) work->grid[v][v] = 1;
  for (int32_t spoke = 0; spoke < 2; spoke++) {
    set_centre_jets(domain->e[spoke], domain->n[spoke], work->centre);
    fs_g2cap_ring_jet(spoke, FS_G2CAP_OUTER, work->grid[0], work->end[0][0]);
    fs_g2cap_spoke_curves(FS_G2CAP_OUTER, work->centre[0][0], work->end[0][0], &work->side[2 * spoke]);
    fs_g2cap_ring_curves(spoke, FS_G2CAP_OUTER, work->grid[0], &work->side[2 * spoke + 1]);
  }
  FS_TRY(fs_g2cap_patch_create(ctx, junction, FS_G2CAP_OUTER, work->side, local));

  /* The coordinates of the domain are functions as well: its vertices, and the polynomials x and y. */
  memset(chart, 0, FS_G2CAP_POINTS * 2 * sizeof *chart);
  fs_dense_add_product(FS_G2CAP_POINTS, FS_G2CAP_VERTICES, 2, 1, local, FS_G2CAP_OUTER, domain->grid[0], 2, chart, 2);
  for (int32_t point = 0; point < FS_G2CAP_POINTS; point++)
    for (int32_t j = 0; j < 2; j++)
      chart[2 * point + j] += local[point * FS_G2CAP_OUTER + FS_G2CAP_VERTICES + fs_g2cap_monomial(1, j)];
done:
  fs_release(ctx, work);
  return status;
}

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

/* A spline of degree 3 or 4 has one or two numbers per spoke; opposite spokes lie on one line. */
static int32_t numbers_per_spoke(int32_t degree) { return degree - 2; }

static int32_t fan_rank(int32_t valence, int32_t degree) {
  int32_t n_lines = valence % 2 == 0 ? valence / 2 : valence;
  return smaller(numbers_per_spoke(degree) * n_lines, degree + 1);
}

static int32_t n_splines(int32_t valence, int32_t degree) {
  return numbers_per_spoke(degree) * valence - fan_rank(valence, degree);
}

int32_t fs_g2cap_n_functions(int32_t valence) {
  return FS_G2CAP_MONOMIALS + n_splines(valence, 3) + n_splines(valence, 4);
}

/* out [degree + 1] = l^3 (degree 3), l^3 m or l^4 (degree 4, which = 0, 1), for the direction t. */
static void spoke_change(int32_t degree, int32_t which, double t, double *out) {
  const double m[2] = {cos(t), sin(t)}, l[2] = {-sin(t), cos(t)};
  double power[5] = {0};
  power[3 + which] = 1; /* y^3, x y^3 or y^4, with x = m and y = l put in */
  fs_g2cap_substitute(degree, power, m, l, out);
}

/* The monomials around the whole centre, seen in the frame of each sector. */
static void add_monomials(int32_t valence, int32_t n_functions, double *fan) {
  for (int32_t sector = 0; sector < valence; sector++) {
    double t = 2 * pi * sector / valence;
    const double X[2] = {cos(t), -sin(t)}, Y[2] = {sin(t), cos(t)};
    for (int32_t d = 0; d <= 4; d++)
      for (int32_t j = 0; j <= d; j++) {
        double monomial[5] = {0}, a[5];
        int32_t function = fs_g2cap_monomial(d, j);
        monomial[j] = 1;
        fs_g2cap_substitute(d, monomial, X, Y, a);
        for (int32_t i = 0; i <= d; i++)
          fan[(FS_G2CAP_MONOMIALS * sector + fs_g2cap_monomial(d, i)) * n_functions + function] = a[i];
      }
  }
}

/* Splines number first, first + 1, .. of the fan. change [degree + 1][per k] has the changes as columns, spoke after
   spoke; in the frame of sector i the spoke j has the direction t_{j-i}, that is, the change of spoke j - i (mod k). */
static void add_splines(int32_t valence, int32_t degree, const double *change, const double *basis, int32_t first,
                        int32_t n_functions, double *fan) {
  int32_t per = numbers_per_spoke(degree), n_columns = per * valence;
  for (int32_t s = 0; s < n_splines(valence, degree); s++)
    for (int32_t sector = 0; sector < valence; sector++)
      for (int32_t i = 0; i <= degree; i++) {
        double sum = 0;
        for (int32_t spoke = 0; spoke <= sector; spoke++) /* zero before spoke 0 */
          for (int32_t which = 0; which < per; which++) {
            int32_t turned = (spoke - sector + valence) % valence;
            sum += basis[s * n_columns + per * spoke + which] * change[i * n_columns + per * turned + which];
          }
        fan[(FS_G2CAP_MONOMIALS * sector + fs_g2cap_monomial(degree, i)) * n_functions + first + s] = sum;
      }
}

static double dot(int32_t n, const double *a, int32_t a_stride, const double *b, int32_t b_stride) {
  double sum = 0;
  for (int32_t i = 0; i < n; i++) sum += a[i * a_stride] * b[i * b_stride];
  return sum;
}

/* basis [n][n_columns] = Q^T basis with Q R = its first n columns, by the Gram-Schmidt process, carried out twice for
   each column [Golub Van Loan 2013, section 5.2]. The trailing columns that are left out belong to neighbouring spokes
   in different directions, as many as the rank: they are independent, so R is regular. */
static fs_status fix_basis(fs_context *ctx, int32_t n, int32_t n_columns, double *basis) {
  fs_status status = FS_OK;
  double *Q = NULL, *given = NULL; /* [n][n], [n][n_columns] */
  FS_ALLOC(ctx, Q, n * n);
  FS_ALLOC(ctx, given, n * n_columns);
  memcpy(given, basis, (size_t)(n * n_columns) * sizeof *given);
  for (int32_t column = 0; column < n; column++) {
    double *q = Q + column, length;
    for (int32_t i = 0; i < n; i++) q[i * n] = given[i * n_columns + column];
    for (int32_t pass = 0; pass < 2; pass++)
      for (int32_t before = 0; before < column; before++) {
        double part = dot(n, Q + before, n, q, n);
        for (int32_t i = 0; i < n; i++) q[i * n] -= part * Q[i * n + before];
      }
    length = sqrt(dot(n, q, n, q, n));
    if (!(length > 1e-7)) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "the splines of a cap depend on each other at column %d of %d", column, n);
      goto done;
    }
    for (int32_t i = 0; i < n; i++) q[i * n] /= length;
  }
  memset(basis, 0, (size_t)(n * n_columns) * sizeof *basis);
  fs_dense_add_product_transposed(n, n, n_columns, 1, Q, n, given, n_columns, basis, n_columns);
done:
  fs_release(ctx, Q);
  fs_release(ctx, given);
  return status;
}

static fs_status add_degree(fs_context *ctx, int32_t valence, int32_t degree, int32_t first, int32_t n_functions,
                            double *fan) {
  fs_status status = FS_OK;
  double *change = NULL, *basis = NULL;
  int32_t per = numbers_per_spoke(degree), n_columns = per * valence;
  FS_ALLOC(ctx, change, (degree + 1) * n_columns);
  FS_ALLOC(ctx, basis, n_splines(valence, degree) * n_columns);
  for (int32_t column = 0; column < n_columns; column++) {
    double a[5];
    spoke_change(degree, column % per, 2 * pi * (column / per) / valence, a);
    for (int32_t i = 0; i <= degree; i++) change[i * n_columns + column] = a[i];
  }
  FS_TRY(fs_dense_null_space(ctx, degree + 1, n_columns, change, fan_rank(valence, degree), basis));
  FS_TRY(fix_basis(ctx, n_splines(valence, degree), n_columns, basis));
  add_splines(valence, degree, change, basis, first, n_functions, fan);
done:
  fs_release(ctx, change);
  fs_release(ctx, basis);
  return status;
}

fs_status fs_g2cap_fan(fs_context *ctx, int32_t valence, double *fan) {
  fs_status status = FS_OK;
  int32_t n_functions = fs_g2cap_n_functions(valence);
  memset(fan, 0, (size_t)(valence * FS_G2CAP_MONOMIALS * n_functions) * sizeof *fan);
  add_monomials(valence, n_functions, fan);
  FS_TRY(add_degree(ctx, valence, 3, FS_G2CAP_MONOMIALS, n_functions, fan));
  FS_TRY(add_degree(ctx, valence, 4, FS_G2CAP_MONOMIALS + n_splines(valence, 3), n_functions, fan));
done:
  return status;
}
