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

     A S = -B,   P = psi + phi S,   K = C + B^T S = C - B^T A^-1 B                                                */
#include "space/g2cap_parts.h"
#include "math/dense.h"

#include <math.h>
#include <string.h>

static const double TOLERANCE = 1e-8; /* of the Bezier points, between sectors */

enum {
  OUTER = FS_G2CAP_OUTER,
  INNER = FS_G2CAP_INNER,
  LOCAL = FS_G2CAP_SECTOR,
  VERTICES = FS_G2CAP_VERTICES,
  MONOMIALS = FS_G2CAP_MONOMIALS,
  POINTS = FS_G2CAP_POINTS
};

fs_status fs_g2cap_eliminate_inner(fs_context *ctx, double *form, double *local) {
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
    int32_t point = fs_g2cap_inner_point(i);
    for (int32_t o = 0; o < OUTER; o++) local[point * OUTER + o] -= X[i * OUTER + o];
  }
  return FS_OK;
}

/* number [15]: position in the net of the vertices that act on a sector. For k = 3 one of them occurs twice. */
static void number_vertices(int32_t valence, int32_t sector, int32_t number[VERTICES]) {
  for (int32_t b = -1; b <= 2; b++)
    for (int32_t a = b < 0 ? 0 : -1; a <= 2; a++) number[fs_g2cap_grid(a, b)] = fs_g2cap_vertex(valence, sector, a, b);
}

/* What the sum over the sectors needs and leaves. */
typedef struct ritz_system {
  int32_t k, n_vertices, n_functions;
  double *fan;         /* [k][15][n'] = P_i */
  double *A;           /* [n'][n'] */
  double *coefficient; /* [n'][6k+1]: B, then S */
  double *energy;      /* [6k+1][6k+1]: C, then K; belongs to the result */
  double *product;     /* [n'][15] or [15][6k+1] */
} ritz_system;

static void add_sector(const ritz_system *system, int32_t sector, const double *form) {
  int32_t n = system->n_functions, width = system->n_vertices, number[VERTICES];
  const double *P = system->fan + sector * MONOMIALS * n, *form_mv = form + VERTICES * LOCAL;
  const double *form_mm = form_mv + VERTICES;
  double *product = system->product;
  number_vertices(system->k, sector, number);
  for (int32_t v = 0; v < VERTICES; v++)
    for (int32_t w = 0; w < VERTICES; w++) system->energy[number[v] * width + number[w]] += form[v * LOCAL + w];

  memset(product, 0, (size_t)(n * VERTICES) * sizeof *product); /* P^T form_mv */
  fs_dense_add_product_transposed(n, MONOMIALS, VERTICES, 1, P, n, form_mv, LOCAL, product, VERTICES);
  for (int32_t l = 0; l < n; l++)
    for (int32_t v = 0; v < VERTICES; v++) system->coefficient[l * width + number[v]] += product[l * VERTICES + v];

  memset(product, 0, (size_t)(n * MONOMIALS) * sizeof *product); /* P^T form_mm */
  fs_dense_add_product_transposed(n, MONOMIALS, MONOMIALS, 1, P, n, form_mm, LOCAL, product, MONOMIALS);
  fs_dense_add_product(n, MONOMIALS, n, 1, product, MONOMIALS, P, n, system->A, n);
}

/* Solves A S = -B; K = C - B^T A^-1 B. */
static fs_status solve_coefficients(fs_context *ctx, ritz_system *system) {
  int32_t n = system->n_functions, width = system->n_vertices;
  double *S = system->coefficient;
  fs_status status = fs_dense_cholesky(ctx, n, system->A, n);
  if (status != FS_OK) return status;
  fs_dense_solve_transposed(n, system->A, n, width, S, width);
  fs_dense_add_gram(n, width, S, width, -1, system->energy, width);
  fs_dense_mirror(width, system->energy, width);
  fs_dense_solve_upper(n, system->A, n, width, S, width);
  for (int32_t i = 0; i < n * width; i++) S[i] = -S[i];
  return FS_OK;
}

/* system->product [15][6k+1] = P_i S: the polynomial at the centre of sector i, for the net as sector 0 sees it. */
static void follow_centre(const ritz_system *system, int32_t sector) {
  int32_t n = system->n_functions, width = system->n_vertices;
  memset(system->product, 0, (size_t)(MONOMIALS * width) * sizeof *system->product);
  fs_dense_add_product(MONOMIALS, n, width, 1, system->fan + sector * MONOMIALS * n, n, system->coefficient, width,
                       system->product, width);
}

/* Column of the vertex that sector s sees as sector 0 sees the vertex of the given column. */
static int32_t turn_column(int32_t k, int32_t sector, int32_t column) {
  return column == 0 ? 0 : 1 + (column - 1 + 6 * sector) % (6 * k);
}

/* What one unit of each monomial moves a Bezier point by, at most. */
static void weigh_monomials(const double *local, double weight[MONOMIALS]) {
  for (int32_t m = 0; m < MONOMIALS; m++) {
    weight[m] = 0;
    for (int32_t point = 0; point < POINTS; point++)
      weight[m] = fmax(weight[m], fabs(local[point * OUTER + VERTICES + m]));
  }
}

/* centre [15][6k+1] = mean of P_i S over the sectors, each turned back. Without rounding all are the same. Their jets
   of a spoke agree between neighbours in spite of rounding in S, and so do those of the mean with its own turned copy:
   the sectors meet to the last digits even where A is ill-conditioned. */
static fs_status average_sectors(fs_context *ctx, const ritz_system *system, fs_g2cap_ritz *ritz) {
  int32_t k = system->k, width = system->n_vertices;
  double weight[MONOMIALS];
  weigh_monomials(ritz->local, weight);
  for (int32_t sector = 0; sector < k; sector++) {
    follow_centre(system, sector);
    for (int32_t m = 0; m < MONOMIALS; m++)
      for (int32_t j = 0; j < width; j++)
        ritz->centre[m * width + j] += system->product[m * width + turn_column(k, sector, j)] / k;
  }
  for (int32_t sector = 0; sector < k; sector++) {
    follow_centre(system, sector);
    for (int32_t m = 0; m < MONOMIALS; m++)
      for (int32_t j = 0; j < width; j++) {
        double difference = ritz->centre[m * width + j] - system->product[m * width + turn_column(k, sector, j)];
        ritz->asymmetry = fmax(ritz->asymmetry, weight[m] * fabs(difference));
      }
  }
  if (ritz->asymmetry < TOLERANCE) return FS_OK;
  return fs_fail(ctx, FS_ERR_NUMERIC, "cap of valence %d: its sectors differ by %g", k, ritz->asymmetry);
}

static fs_status minimise(fs_context *ctx, const double *form, fs_g2cap_ritz *ritz) {
  fs_status status = FS_OK;
  int32_t k = ritz->valence, n = fs_g2cap_n_functions(k), width = ritz->n_vertices;
  ritz_system system = {.k = k, .n_vertices = width, .n_functions = n, .energy = ritz->energy};
  FS_ALLOC(ctx, system.fan, k * MONOMIALS * n);
  FS_ALLOC(ctx, system.A, n * n);
  FS_ALLOC(ctx, system.coefficient, n * width);
  FS_ALLOC(ctx, system.product, MONOMIALS * width); /* n' <= 6 k + 1 */
  FS_TRY(fs_g2cap_fan(ctx, k, system.fan));
  for (int32_t sector = 0; sector < k; sector++) add_sector(&system, sector, form);
  FS_TRY(solve_coefficients(ctx, &system));
  FS_TRY(average_sectors(ctx, &system, ritz));
done:
  fs_release(ctx, system.fan);
  fs_release(ctx, system.A);
  fs_release(ctx, system.coefficient);
  fs_release(ctx, system.product);
  return status;
}

fs_status fs_g2cap_ritz_create(fs_context *ctx, int32_t valence, const fs_g2cap_options *options, const double *local,
                               const double *chart, fs_g2cap_ritz **out) {
  fs_status status = FS_OK;
  fs_g2cap_ritz *ritz = NULL;
  double *form = NULL;
  FS_ALLOC(ctx, ritz, 1);
  ritz->valence = valence;
  ritz->n_vertices = 6 * valence + 1;
  FS_ALLOC(ctx, ritz->local, POINTS * OUTER);
  FS_ALLOC(ctx, ritz->centre, MONOMIALS * ritz->n_vertices);
  FS_ALLOC(ctx, ritz->energy, ritz->n_vertices * ritz->n_vertices);
  FS_ALLOC(ctx, form, LOCAL * LOCAL);
  memcpy(ritz->local, local, POINTS * OUTER * sizeof *local);
  FS_TRY(fs_g2cap_form_matrix(ctx, options, local, chart, form));
  if (!options->basic) FS_TRY(fs_g2cap_eliminate_inner(ctx, form, ritz->local));
  FS_TRY(minimise(ctx, form, ritz));
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
  fs_release(ctx, ritz->centre);
  fs_release(ctx, ritz->energy);
  fs_release(ctx, ritz);
}

void fs_g2cap_matrix(const fs_g2cap_ritz *ritz, double *matrix) {
  int32_t width = ritz->n_vertices, number[VERTICES];
  memset(matrix, 0, (size_t)(POINTS * width) * sizeof *matrix);
  number_vertices(ritz->valence, 0, number);
  for (int32_t point = 0; point < POINTS; point++)
    for (int32_t v = 0; v < VERTICES; v++) matrix[point * width + number[v]] += ritz->local[point * OUTER + v];
  fs_dense_add_product(POINTS, MONOMIALS, width, 1, ritz->local + VERTICES, OUTER, ritz->centre, width, matrix, width);
}
