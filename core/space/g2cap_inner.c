/* SPDX-License-Identifier: MIT */
/* Single role: the inner functions of a cap, orthonormal in the energy. [Kiciak 2013; docs/g2caps.md section 10]

     phi*_l   phi_l with the inner chi of every sector that make its energy least: in sector i the outer functions after
              elimination, local (z part), times P_i (fan)
     chi      16 per sector; form_ii = R_c^T R_c
     A*       <phi*, phi*> = sum_i P_i^T form_mm P_i;   D A* D = R^T R with D = diag(A*)^-1/2

     smooth = phi* D R^-1,   local = chi R_c^-1

   The domain is scaled to the area 1 per sector. phi* is orthogonal to chi, chi of different sectors do not meet, and
   the functions of the matrix of a cap, being minima, are orthogonal to all of them. The orthonormalisation is done
   twice: the second time the matrix is the identity but for the rounding of the first. */
#include "space/g2cap_parts.h"
#include "math/dense.h"

#include <math.h>
#include <string.h>

enum {
  OUTER = FS_G2CAP_OUTER,
  INNER = FS_G2CAP_INNER,
  SECTOR = FS_G2CAP_SECTOR,
  VERTICES = FS_G2CAP_VERTICES,
  MONOMIALS = FS_G2CAP_MONOMIALS,
  POINTS = FS_G2CAP_POINTS,
  MAX_NET = 6 * FS_G2CAP_MAX_VALENCE + 1
};

/* The functions of one sector, and their energies. */
typedef struct workspace {
  double net[MAX_NET * 2], chart[POINTS * 2], outer[POINTS * OUTER], form[SECTOR * SECTOR];
} workspace;

static fs_status allocate_inner(fs_context *ctx, int32_t valence, fs_g2cap_inner **out) {
  fs_status status = FS_OK;
  fs_g2cap_inner *inner = NULL;
  FS_ALLOC(ctx, inner, 1);
  inner->valence = valence;
  inner->n_smooth = fs_g2cap_n_functions(valence);
  FS_ALLOC(ctx, inner->smooth, valence * POINTS * inner->n_smooth);
  FS_ALLOC(ctx, inner->local, POINTS * FS_G2CAP_LOCAL);
  *out = inner;
  inner = NULL;
done:
  fs_g2cap_inner_free(ctx, inner);
  return status;
}

/* B [rows][n] = B R^-1, R [n][n] upper triangular. */
static void solve_right(int32_t rows, int32_t n, const double *R, int32_t r_stride, double *B, int32_t b_stride) {
  for (int32_t row = 0; row < rows; row++) {
    double *b = B + row * b_stride;
    for (int32_t i = 0; i < n; i++) {
      b[i] /= R[i * r_stride + i];
      for (int32_t j = i + 1; j < n; j++) b[j] -= b[i] * R[i * r_stride + j];
    }
  }
}

/* fan [k][15][n'] with the combinations of its columns that are orthonormal; form_mm [15][15] within a larger matrix;
   A [n'][n'] and product [n'][15] are work space. */
static fs_status orthonormalise(fs_context *ctx, int32_t valence, int32_t n, const double *form_mm, double *fan,
                                double *A, double *product) {
  fs_status status;
  memset(A, 0, (size_t)(n * n) * sizeof *A);
  for (int32_t sector = 0; sector < valence; sector++) {
    const double *P = fan + sector * MONOMIALS * n;
    memset(product, 0, (size_t)(n * MONOMIALS) * sizeof *product);
    fs_dense_add_product_transposed(n, MONOMIALS, MONOMIALS, 1, P, n, form_mm, SECTOR, product, MONOMIALS);
    fs_dense_add_product(n, MONOMIALS, n, 1, product, MONOMIALS, P, n, A, n);
  }
  for (int32_t i = 0; i < n; i++) product[i] = 1 / sqrt(A[i * (n + 1)]); /* D */
  for (int32_t i = 0; i < n; i++)
    for (int32_t j = 0; j < n; j++) A[i * n + j] *= product[i] * product[j];
  for (int32_t row = 0; row < valence * MONOMIALS; row++)
    for (int32_t j = 0; j < n; j++) fan[row * n + j] *= product[j];
  status = fs_dense_cholesky(ctx, n, A, n);
  if (status == FS_OK) solve_right(valence * MONOMIALS, n, A, n, fan, n);
  return status;
}

static fs_status make_smooth(fs_context *ctx, const workspace *work, fs_g2cap_inner *inner) {
  fs_status status = FS_OK;
  int32_t k = inner->valence, n = inner->n_smooth;
  double *fan = NULL, *A = NULL, *product = NULL;
  FS_ALLOC(ctx, fan, k * MONOMIALS * n);
  FS_ALLOC(ctx, A, n * n);
  FS_ALLOC(ctx, product, n * MONOMIALS);
  FS_TRY(fs_g2cap_fan(ctx, k, fan));
  for (int32_t pass = 0; pass < 2; pass++)
    FS_TRY(orthonormalise(ctx, k, n, work->form + VERTICES * (SECTOR + 1), fan, A, product));
  for (int32_t sector = 0; sector < k; sector++)
    fs_dense_add_product(POINTS, MONOMIALS, n, 1, work->outer + VERTICES, OUTER, fan + sector * MONOMIALS * n, n,
                         inner->smooth + sector * POINTS * n, n);
done:
  fs_release(ctx, fan);
  fs_release(ctx, A);
  fs_release(ctx, product);
  return status;
}

/* After the elimination form_ii holds R_c. */
static void make_local(const workspace *work, fs_g2cap_inner *inner) {
  double chi[INNER * INNER] = {0};
  for (int32_t i = 0; i < INNER; i++) chi[i * (INNER + 1)] = 1;
  solve_right(INNER, INNER, work->form + OUTER * (SECTOR + 1), SECTOR, chi, INNER);
  for (int32_t i = 0; i < INNER; i++)
    memcpy(inner->local + fs_g2cap_inner_point(i) * INNER, chi + i * INNER, INNER * sizeof *chi);
}

fs_status fs_g2cap_inner_create(fs_context *ctx, int32_t valence, fs_g2cap_inner **out) {
  static const fs_g2cap_options defaults = {0};
  fs_status status = FS_OK;
  fs_g2cap_inner *inner = NULL;
  workspace *work = NULL;
  FS_TRY(fs_g2cap_check_valence(ctx, valence));
  FS_ALLOC(ctx, work, 1);
  FS_TRY(allocate_inner(ctx, valence, &inner));
  FS_TRY(fs_g2cap_sector(ctx, valence, work->net, work->outer, work->chart));
  FS_TRY(fs_g2cap_scale_chart(ctx, work->chart));
  FS_TRY(fs_g2cap_form_matrix(ctx, &defaults, work->outer, work->chart, work->form));
  FS_TRY(fs_g2cap_eliminate_inner(ctx, work->form, work->outer));
  FS_TRY(make_smooth(ctx, work, inner));
  make_local(work, inner);
  *out = inner;
  inner = NULL;
done:
  fs_g2cap_inner_free(ctx, inner);
  fs_release(ctx, work);
  return status;
}

void fs_g2cap_inner_free(fs_context *ctx, fs_g2cap_inner *inner) {
  if (inner == NULL) return;
  fs_release(ctx, inner->smooth);
  fs_release(ctx, inner->local);
  fs_release(ctx, inner);
}
