/* SPDX-License-Identifier: MIT */
/* Single role: the functions of a cap that minimise the energy for given vertices of the net. [Kiciak 2013;
   docs/g2caps.md section 9]

     psi_j      one per vertex of the net, zero jets at the centre
     phi_l      zero on the ring; P_i (fan) holds their monomial coefficients in sector i
     chi        16 inner functions per sector
     Phi        energy, the bilinear form <f, g>

   All sectors are congruent, so one form matrix of 46 functions serves all. The functions chi of a sector meet those of
   no other: they are eliminated first, in the 46 functions of the sector (X = solution, o: outer, i: inner),

     X = form_ii^-1 form_io,   form_oo -= form_oi X,   L -= (Bezier points of chi) X

   and what remains is summed over the sectors to A = <phi, phi>, B = <phi, psi>, C = <psi, psi>:

     A S = -B,   P = psi + phi S,   K = C + B^T S = C - B^T A^-1 B                                                 */
#include "space/g2cap_parts.h"
#include "math/dense.h"

#include <string.h>

enum {
  OUTER = FS_G2CAP_OUTER,
  INNER = FS_G2CAP_INNER,
  LOCAL = OUTER + INNER,
  VERTICES = FS_G2CAP_VERTICES,
  MONOMIALS = FS_G2CAP_MONOMIALS,
  POINTS = FS_G2CAP_POINTS
};

/* Eliminates the inner functions from the form matrix [46][46], whose upper left [30][30] remains, and from L. */
static fs_status eliminate_inner(fs_context *ctx, double *form, double *local) {
  double *inner = form + OUTER * LOCAL + OUTER, X[INNER * OUTER];
  fs_status status;
  for (int32_t i = 0; i < INNER; i++) memcpy(X + i * OUTER, form + (OUTER + i) * LOCAL, OUTER * sizeof(double));
  status = fs_dense_cholesky(ctx, INNER, inner, LOCAL);
  if (status != FS_OK) return status;
  fs_dense_solve_transposed(INNER, inner, LOCAL, OUTER, X, OUTER);
  fs_dense_add_gram(INNER, OUTER, X, OUTER, -1, form, LOCAL);
  fs_dense_mirror(OUTER, form, LOCAL);
  fs_dense_solve_upper(INNER, inner, LOCAL, OUTER, X, OUTER);
  for (int32_t i = 0; i < INNER; i++) {
    int32_t point = 3 + i % 4 + 10 * (3 + i / 4);
    for (int32_t o = 0; o < OUTER; o++) local[point * OUTER + o] -= X[i * OUTER + o];
  }
  return FS_OK;
}

/* number [15]: position in the net of the vertices that act on a sector. For k = 3 one of them occurs twice. */
static void number_vertices(int32_t valence, int32_t sector, int32_t number[VERTICES]) {
  for (int32_t b = -1; b <= 2; b++)
    for (int32_t a = b < 0 ? 0 : -1; a <= 2; a++) number[fs_g2cap_grid(a, b)] = fs_g2cap_vertex(valence, sector, a, b);
}

/* The sums A [n'][n'], B [n'][6k+1], C [6k+1][6k+1]; product is room for [n'][15]. */
static void add_sector(const fs_g2cap_ritz *ritz, int32_t sector, const double *form, double *product, double *A,
                       double *B, double *C) {
  int32_t n = ritz->n_functions, n_vertices = ritz->n_vertices, number[VERTICES];
  const double *P = ritz->fan + sector * MONOMIALS * n, *form_mv = form + VERTICES * LOCAL,
               *form_mm = form_mv + VERTICES;
  number_vertices(ritz->valence, sector, number);
  for (int32_t v = 0; v < VERTICES; v++)
    for (int32_t w = 0; w < VERTICES; w++) C[number[v] * n_vertices + number[w]] += form[v * LOCAL + w];

  memset(product, 0, (size_t)(n * VERTICES) * sizeof *product); /* P^T form_mv */
  fs_dense_add_product_transposed(n, MONOMIALS, VERTICES, 1, P, n, form_mv, LOCAL, product, VERTICES);
  for (int32_t l = 0; l < n; l++)
    for (int32_t v = 0; v < VERTICES; v++) B[l * n_vertices + number[v]] += product[l * VERTICES + v];

  memset(product, 0, (size_t)(n * MONOMIALS) * sizeof *product); /* P^T form_mm */
  fs_dense_add_product_transposed(n, MONOMIALS, MONOMIALS, 1, P, n, form_mm, LOCAL, product, MONOMIALS);
  fs_dense_add_product(n, MONOMIALS, n, 1, product, MONOMIALS, P, n, A, n);
}

/* Solves A S = -B; K = C - B^T A^-1 B is left in ritz->energy, which holds C before. */
static fs_status solve_coefficients(fs_context *ctx, fs_g2cap_ritz *ritz, double *A) {
  int32_t n = ritz->n_functions, width = ritz->n_vertices;
  double *S = ritz->coefficient;
  fs_status status = fs_dense_cholesky(ctx, n, A, n);
  if (status != FS_OK) return status;
  fs_dense_solve_transposed(n, A, n, width, S, width);
  fs_dense_add_gram(n, width, S, width, -1, ritz->energy, width);
  fs_dense_mirror(width, ritz->energy, width);
  fs_dense_solve_upper(n, A, n, width, S, width);
  for (int32_t i = 0; i < n * width; i++) S[i] = -S[i];
  return FS_OK;
}

static fs_status minimise(fs_context *ctx, fs_g2cap_ritz *ritz, const double *form) {
  fs_status status = FS_OK;
  int32_t n = ritz->n_functions;
  double *A = NULL, *product = NULL;
  FS_ALLOC(ctx, A, n * n);
  FS_ALLOC(ctx, product, n * VERTICES);
  for (int32_t sector = 0; sector < ritz->valence; sector++)
    add_sector(ritz, sector, form, product, A, ritz->coefficient, ritz->energy);
  FS_TRY(solve_coefficients(ctx, ritz, A));
done:
  fs_release(ctx, A);
  fs_release(ctx, product);
  return status;
}

fs_status fs_g2cap_ritz_create(fs_context *ctx, const fs_g2cap_domain *domain, const fs_g2cap_options *options,
                               const double *local, const double *chart, fs_g2cap_ritz **out) {
  fs_status status = FS_OK;
  fs_g2cap_ritz *ritz = NULL;
  double *form = NULL;
  int32_t k = domain->valence;
  FS_ALLOC(ctx, ritz, 1);
  ritz->valence = k;
  ritz->n_vertices = 6 * k + 1;
  ritz->n_functions = fs_g2cap_n_functions(k);
  FS_ALLOC(ctx, ritz->local, POINTS * OUTER);
  FS_ALLOC(ctx, ritz->fan, k * MONOMIALS * ritz->n_functions);
  FS_ALLOC(ctx, ritz->coefficient, ritz->n_functions * ritz->n_vertices);
  FS_ALLOC(ctx, ritz->energy, ritz->n_vertices * ritz->n_vertices);
  FS_ALLOC(ctx, form, LOCAL * LOCAL);
  memcpy(ritz->local, local, POINTS * OUTER * sizeof *local);
  FS_TRY(fs_g2cap_form_matrix(ctx, options, local, chart, form));
  if (!options->basic) FS_TRY(eliminate_inner(ctx, form, ritz->local));
  FS_TRY(fs_g2cap_fan(ctx, k, ritz->fan));
  FS_TRY(minimise(ctx, ritz, form));
  *out = ritz;
  ritz = NULL;
done:
  fs_g2cap_ritz_free(ctx, ritz);
  fs_release(ctx, form);
  return status;
}

void fs_g2cap_ritz_free(fs_context *ctx, fs_g2cap_ritz *ritz) {
  if (ritz == NULL) return;
  fs_release(ctx, ritz->local);
  fs_release(ctx, ritz->fan);
  fs_release(ctx, ritz->coefficient);
  fs_release(ctx, ritz->energy);
  fs_release(ctx, ritz);
}

fs_status fs_g2cap_sector_matrix(fs_context *ctx, const fs_g2cap_ritz *ritz, int32_t sector, double *matrix) {
  fs_status status = FS_OK;
  int32_t n = ritz->n_functions, width = ritz->n_vertices, number[VERTICES];
  double *phi = NULL; /* [100][n'] Bezier points of the functions phi */
  FS_ALLOC(ctx, phi, POINTS * n);
  memset(matrix, 0, (size_t)(POINTS * width) * sizeof *matrix);
  number_vertices(ritz->valence, sector, number);
  for (int32_t point = 0; point < POINTS; point++)
    for (int32_t v = 0; v < VERTICES; v++) matrix[point * width + number[v]] += ritz->local[point * OUTER + v];
  fs_dense_add_product(POINTS, MONOMIALS, n, 1, ritz->local + VERTICES, OUTER, ritz->fan + sector * MONOMIALS * n, n,
                       phi, n);
  fs_dense_add_product(POINTS, n, width, 1, phi, n, ritz->coefficient, width, matrix, width);
done:
  fs_release(ctx, phi);
  return status;
}
