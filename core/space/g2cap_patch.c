/* SPDX-License-Identifier: MIT */
/* Single role: the patch of degree (9, 9) with given curves along its four sides. [Coons 1967; Kiciak 2013;
   docs/g2caps.md section 6]

     c[e][n](u) n-th derivative in v along v = e      c[.][0] = r,  c[.][1] = b1 r_u + c1 r_s
                                                      c[.][2] = b2 r_u + c2 r_s + b1^2 r_uu + 2 b1 c1 r_us + c1^2 r_ss
     d[e][n](v) n-th derivative in u along u = e      the same with f, g
     H_{e,n}    quintic whose n-th derivative at e is 1, the other five end data 0; raised to degree 9
     K[g][l][e][n] = l-th derivative of c[e][n] at u = g

     p = sum_{e,n} (c[e][n](u) - sum_{g,l} K[g][l][e][n] H_{g,l}(u)) H_{e,n}(v) + sum_{e,n} d[e][n](v) H_{e,n}(u)   */
#include "space/g2cap_parts.h"
#include "math/bernstein.h"

#include <string.h>

enum { N = FS_G2CAP_DEGREE, ROWS = N + 1, WIDTH = FS_G2CAP_OUTER };

typedef struct workspace {
  double side[4][3][ROWS * WIDTH]; /* c[0], c[1], d[0], d[1]; each [10][width] */
  double derivative[3][7 * WIDTH]; /* r_u, r_uu, r_us */
  double blending[2][3][ROWS];     /* H */
} workspace;

static void set_blending(double H[2][3][ROWS]) {
  for (int32_t e = 0; e < 2; e++)
    for (int32_t n = 0; n < 3; n++) {
      double data[2][3] = {{0}}, quintic[6];
      data[e][n] = 1;
      fs_bernstein_hermite(1, 3, data[0], 3, data[1], quintic);
      fs_bernstein_elevate(5, 1, quintic, N, H[e][n]);
    }
}

/* out [10][width] += factor a p. The scalar polynomial a is raised so that the product has degree 9. */
static void add_raised(double factor, int32_t a_degree, const double *a, int32_t degree, int32_t width, const double *p,
                       double *out) {
  double raised[ROWS];
  fs_bernstein_elevate(a_degree, 1, a, N - degree, raised);
  for (int32_t i = 0; i <= N - degree; i++) raised[i] *= factor;
  fs_bernstein_add_product(N - degree, raised, degree, width, p, out);
}

/* side [3][10 width]: the patch and its two cross derivatives along a side. */
static void set_side(const fs_g2cap_junction *junction, int32_t along, int32_t across, int32_t boundary, int32_t width,
                     const fs_g2cap_curves *curves, workspace *work, double side[3][ROWS * WIDTH]) {
  static const double one[1] = {1};
  int32_t b1 = fs_g2cap_function(along, boundary, 1), b2 = fs_g2cap_function(along, boundary, 2);
  int32_t c1 = fs_g2cap_function(across, boundary, 1), c2 = fs_g2cap_function(across, boundary, 2);
  const int32_t *degree = junction->degree, *r_degree = curves->degree;
  const double(*p)[6] = junction->polynomial;
  const double *r = curves->value[0], *rs = curves->value[1], *rss = curves->value[2];
  double *ru = work->derivative[0], *ruu = work->derivative[1], *rus = work->derivative[2];
  double bb[9] = {0}, bc[8] = {0}, cc[7] = {0};

  fs_bernstein_differentiate(r_degree[0], width, r, ru);
  fs_bernstein_differentiate(r_degree[0] - 1, width, ru, ruu);
  fs_bernstein_differentiate(r_degree[1], width, rs, rus);
  fs_bernstein_add_product(degree[b1], p[b1], degree[b1], 1, p[b1], bb);
  fs_bernstein_add_product(degree[b1], p[b1], degree[c1], 1, p[c1], bc);
  fs_bernstein_add_product(degree[c1], p[c1], degree[c1], 1, p[c1], cc);

  memset(side, 0, 3 * sizeof side[0]);
  add_raised(1, 0, one, r_degree[0], width, r, side[0]);
  add_raised(1, degree[b1], p[b1], r_degree[0] - 1, width, ru, side[1]);
  add_raised(1, degree[c1], p[c1], r_degree[1], width, rs, side[1]);
  add_raised(1, degree[b2], p[b2], r_degree[0] - 1, width, ru, side[2]);
  add_raised(1, degree[c2], p[c2], r_degree[1], width, rs, side[2]);
  add_raised(1, 2 * degree[b1], bb, r_degree[0] - 2, width, ruu, side[2]);
  add_raised(2, degree[b1] + degree[c1], bc, r_degree[1] - 1, width, rus, side[2]);
  add_raised(1, 2 * degree[c1], cc, r_degree[2], width, rss, side[2]);
}

/* c -= sum_{g,l} c^(l)(g) H_{g,l}: the first and last three coefficients become zero (up to rounding). */
static void subtract_ends(int32_t width, double H[2][3][ROWS], double *c) {
  for (int32_t w = 0; w < width; w++) {
    double q[ROWS], derivative[2][3];
    for (int32_t i = 0; i < ROWS; i++) q[i] = c[i * width + w];
    derivative[0][0] = q[0], derivative[0][1] = N * (q[1] - q[0]);
    derivative[0][2] = N * (N - 1) * (q[2] - 2 * q[1] + q[0]);
    derivative[1][0] = q[N], derivative[1][1] = N * (q[N] - q[N - 1]);
    derivative[1][2] = N * (N - 1) * (q[N] - 2 * q[N - 1] + q[N - 2]);
    for (int32_t g = 0; g < 2; g++)
      for (int32_t l = 0; l < 3; l++)
        for (int32_t i = 0; i < ROWS; i++) c[i * width + w] -= derivative[g][l] * H[g][l][i];
  }
}

/* row [width] of the Bezier point (i, j) */
static void blend_point(int32_t i, int32_t j, int32_t width, const workspace *work, double *row) {
  for (int32_t e = 0; e < 2; e++)
    for (int32_t n = 0; n < 3; n++) {
      const double *c = work->side[e][n] + i * width, *d = work->side[2 + e][n] + j * width;
      double h_v = work->blending[e][n][j], h_u = work->blending[e][n][i];
      for (int32_t w = 0; w < width; w++) row[w] += c[w] * h_v + d[w] * h_u;
    }
}

fs_status fs_g2cap_patch_create(fs_context *ctx, const fs_g2cap_junction *junction, int32_t width,
                                const fs_g2cap_curves side[4], double *patch) {
  fs_status status = FS_OK;
  workspace *work = NULL;
  FS_ALLOC(ctx, work, 1);
  set_blending(work->blending);
  for (int32_t s = 0; s < 4; s++)
    set_side(junction, s < 2 ? FS_G2CAP_B : FS_G2CAP_F, s < 2 ? FS_G2CAP_C : FS_G2CAP_G, s % 2, width, &side[s], work,
             work->side[s]);
  for (int32_t e = 0; e < 2; e++)
    for (int32_t n = 0; n < 3; n++) subtract_ends(width, work->blending, work->side[e][n]);
  memset(patch, 0, (size_t)(FS_G2CAP_POINTS * width) * sizeof *patch);
  for (int32_t j = 0; j < ROWS; j++)
    for (int32_t i = 0; i < ROWS; i++) blend_point(i, j, width, work, patch + (i + ROWS * j) * width);
done:
  fs_release(ctx, work);
  return status;
}
