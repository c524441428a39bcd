/* SPDX-License-Identifier: MIT */
/* What the files g2cap_*.c share: the steps of the construction of a cap, in order. [Kiciak 2013; docs/g2caps.md]

     symbol     code                  shape            meaning
     k          valence                                number of sectors
     V_i(a,b)   grid                  [15][width]      vertices a, b = -1 .. 2 without (-1,-1), of sector 0 or another
     r, r_s, .. fs_g2cap_curves                        curve along a side and its first two cross derivatives
     d^m_u d^n_s r   jet              [3 n][m][width]  derivatives at an end of a side
     b, c, f, g fs_g2cap_junction                      junction functions
     L          local                 [100][30]        patches of the functions given by 15 vertices and 15 monomials
     P_i        fan                   [k][15][n']      functions phi: their monomial coefficients in sector i
     S          coefficient           [n'][6k+1]       Ritz coefficients: P = psi + phi S
     P_i S      centre                [15][6k+1]       polynomial at the centre in terms of the net, one for all sectors

   Bezier points of patches: point (i, j), i along u, is row i + 10 j.                                               */
#ifndef FS_SPACE_G2CAP_PARTS_H
#define FS_SPACE_G2CAP_PARTS_H

#include "space/g2cap.h"

enum {
  FS_G2CAP_DEGREE = 9,
  FS_G2CAP_POINTS = 100,
  FS_G2CAP_VERTICES = 15,  /* that act on a sector directly */
  FS_G2CAP_MONOMIALS = 15, /* x^(d-j) y^j, d <= 4, in order of d, then j */
  FS_G2CAP_OUTER = 30,     /* both together: functions that act on the sides of a sector */
  FS_G2CAP_INNER = 16,     /* functions that do not: B_a^9(u) B_b^9(v), a, b = 3 .. 6 */
  FS_G2CAP_SECTOR = FS_G2CAP_OUTER + FS_G2CAP_INNER
};

/* ---- g2cap_form.c: homogeneous polynomials sum_j a_j x^(d-j) y^j ---- */

/* Position of x^(d-j) y^j among the monomials. */
static inline int32_t fs_g2cap_monomial(int32_t d, int32_t j) { return d * (d + 1) / 2 + j; }

/* out [degree + 1]: the polynomial a with x = X[0] x' + X[1] y', y = Y[0] x' + Y[1] y' substituted; degree <= 4. */
void fs_g2cap_substitute(int32_t degree, const double *a, const double X[2], const double Y[2], double *out);

/* ---- g2cap_domain.c: the net of the plane domain, jets and curves that a net imposes ---- */

/* Number of V_i(a,b) in the net of 6 k + 1 vertices; a or b may be -1 or -2 (not both). */
int32_t fs_g2cap_vertex(int32_t valence, int32_t sector, int32_t a, int32_t b);

/* Row of V(a,b) in a grid, a, b = -1 .. 2. */
static inline int32_t fs_g2cap_grid(int32_t a, int32_t b) { return 4 * b + a + 4; }

/* net [6k+1][2] of the plane domain; *eigenvalue belongs to it under refinement. */
void fs_g2cap_domain_net(int32_t valence, double *eigenvalue, double *net);

/* A side: curve n has coefficients value[n], [degree[n] + 1][width]; n-th cross derivative. */
typedef struct fs_g2cap_curves {
  int32_t degree[3];
  double value[3][8 * FS_G2CAP_OUTER];
} fs_g2cap_curves;

/* The curves that the surrounding bicubic patches impose on the side u = 1 (along = 1) or v = 1 (along = 0). */
void fs_g2cap_ring_curves(int32_t along, int32_t width, const double *grid, fs_g2cap_curves *curves);

/* jet [3][3][width], d^m_alpha d^n_beta of the surrounding patches at the end of spoke 0 or 1, alpha along it. */
void fs_g2cap_ring_jet(int32_t spoke, int32_t width, const double *grid, double *jet);

/* Curves r, r_s, r_ss along a spoke, of degrees 7, 6, 5, with jets at the centre [3][5][width] (of which orders
   m <= 4, 3, 2 are used for n = 0, 1, 2) and at the end of the spoke [3][3][width]. */
void fs_g2cap_spoke_curves(int32_t width, const double *centre, const double *end, fs_g2cap_curves *curves);

/* Everything about sector 0 of the plane domain that the other steps need. */
typedef struct fs_g2cap_domain {
  int32_t valence;
  double eigenvalue;
  double grid[FS_G2CAP_VERTICES][2];
  double e[2][2], n[2][2]; /* of spokes 0 and 1: end of the spoke minus centre, cross derivative */
} fs_g2cap_domain;
void fs_g2cap_domain_set(int32_t valence, double eigenvalue, const double *net, fs_g2cap_domain *domain);

/* ---- g2cap_junction.c: junction functions ---- */

enum { FS_G2CAP_B, FS_G2CAP_C, FS_G2CAP_F, FS_G2CAP_G };

/* Number of a junction function: letter b c f g; side 0 through the centre, 1 on the boundary; order 1 or 2. */
static inline int32_t fs_g2cap_function(int32_t letter, int32_t side, int32_t order) {
  return 4 * letter + 2 * side + order - 1;
}
typedef struct fs_g2cap_junction {
  int32_t degree[16];
  double polynomial[16][6]; /* Bernstein coefficients */
  double residual;          /* largest of the compatibility equations at the four corners */
} fs_g2cap_junction;
fs_status fs_g2cap_junction_solve(fs_context *ctx, const fs_g2cap_domain *domain, fs_g2cap_junction *junction);

/* ---- g2cap_patch.c: side data, Coons patch ---- */

/* Sides in this order: v = 0, v = 1, u = 0, u = 1. patch [100][width], width <= 30. */
fs_status fs_g2cap_patch_create(fs_context *ctx, const fs_g2cap_junction *junction, int32_t width,
                                const fs_g2cap_curves side[4], double *patch);

/* ---- g2cap_basis.c: functions of the space ---- */

/* local [100][30] = L, chart [100][2] = domain patch of sector 0 (not yet scaled). */
fs_status fs_g2cap_local_patches(fs_context *ctx, const fs_g2cap_domain *domain, const fs_g2cap_junction *junction,
                                 double *local, double *chart);

/* Number n' of functions phi, and their coefficients fan [k][15][n'] in the frame of each sector. */
int32_t fs_g2cap_n_functions(int32_t valence);
fs_status fs_g2cap_fan(fs_context *ctx, int32_t valence, double *fan);

/* ---- g2cap.c: the plane domain and the functions of a sector ---- */

/* FS_ERR_ARGUMENT unless there are caps of this valence. */
fs_status fs_g2cap_check_valence(fs_context *ctx, int32_t valence);

/* net [6k+1][2], local [100][30], chart [100][2], from the valence alone. */
fs_status fs_g2cap_sector(fs_context *ctx, int32_t valence, double *net, double *local, double *chart);

/* Scales the chart [100][2] to the area 1. */
fs_status fs_g2cap_scale_chart(fs_context *ctx, double *chart);

/* ---- g2cap_form_matrix.c: the energy of one sector ---- */

/* form [46][46]: integrals of <grad Laplace f, grad Laplace g> over sector 0, f and g among the 30 outer, then 16 inner
   functions. */
fs_status fs_g2cap_form_matrix(fs_context *ctx, const fs_g2cap_options *options, const double *local,
                               const double *chart, double *form);

/* area [1] of the sector with the given chart. */
fs_status fs_g2cap_area(fs_context *ctx, const double *chart, double *area);

/* ---- g2cap_ritz.c: the minimum of the energy ---- */

/* Number of the Bezier point of the inner function i = a + 4 b, a, b = 0 .. 3. */
static inline int32_t fs_g2cap_inner_point(int32_t i) { return 3 + i % 4 + (FS_G2CAP_DEGREE + 1) * (3 + i / 4); }

/* Adds to each of the outer functions, local [100][30], the inner ones that make its energy least. The upper left
   [30][30] of form [46][46] becomes their form matrix, the lower right [16][16] the R of form_ii = R^T R. */
fs_status fs_g2cap_eliminate_inner(fs_context *ctx, double *form, double *local);

typedef struct fs_g2cap_ritz {
  int32_t valence, n_vertices;
  double *local;    /* [100][30] with the best inner functions added */
  double *centre;   /* [15][6k+1]: the polynomial that sector 0 follows at the centre */
  double *energy;   /* [6k+1][6k+1], the matrix K */
  double asymmetry; /* what differences between the sectors did to Bezier points, before the mean was taken */
} fs_g2cap_ritz;
fs_status fs_g2cap_ritz_create(fs_context *ctx, int32_t valence, const fs_g2cap_options *options, const double *local,
                               const double *chart, fs_g2cap_ritz **ritz);
void fs_g2cap_ritz_free(fs_context *ctx, fs_g2cap_ritz *ritz);

/* matrix [100][6k+1]: Bezier points of sector 0 from the net. */
void fs_g2cap_matrix(const fs_g2cap_ritz *ritz, double *matrix);

#endif
