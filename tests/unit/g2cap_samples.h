/* SPDX-License-Identifier: MIT */
/* What the tests of caps share: the steps of the construction in a row, and patches at points. */
#ifndef FS_TEST_G2CAP_SAMPLES_H
#define FS_TEST_G2CAP_SAMPLES_H

#include "math/bernstein.h"
#include "math/diffgeo.h"
#include "space/g2cap_parts.h"
#include <fairsurf/space.h>
#include "../support/support.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static inline void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

/* All that is computed on the way to a cap. */
typedef struct construction {
  int k, n; /* n = 6 k + 1 */
  double eigenvalue, net[2 * (6 * FS_G2CAP_MAX_VALENCE + 1)];
  fs_g2cap_domain domain;
  fs_g2cap_junction junction;
  double local[FS_G2CAP_POINTS * FS_G2CAP_OUTER], chart[2 * FS_G2CAP_POINTS];
  fs_g2cap_ritz *ritz;
} construction;

static inline construction *construct(fs_context *ctx, int k, const fs_g2cap_options *options) {
  construction *c = calloc(1, sizeof *c);
  assert_non_null(c);
  c->k = k, c->n = 6 * k + 1;
  fs_g2cap_domain_net(k, &c->eigenvalue, c->net);
  fs_g2cap_domain_set(k, c->eigenvalue, c->net, &c->domain);
  assert_int_equal(fs_g2cap_junction_solve(ctx, &c->domain, &c->junction), FS_OK);
  assert_int_equal(fs_g2cap_local_patches(ctx, &c->domain, &c->junction, c->local, c->chart), FS_OK);
  assert_int_equal(fs_g2cap_ritz_create(ctx, k, options, c->local, c->chart, &c->ritz), FS_OK);
  return c;
}

static inline void destroy(fs_context *ctx, construction *c) {
  fs_g2cap_ritz_free(ctx, c->ritz);
  free(c);
}

/* points [100][width] = matrix times the net [6k+1][width] as sector s sees it. */
static inline void fill_sector(int k, const double *matrix, int s, int width, const double *net, double *points) {
  int n = 6 * k + 1;
  for (int row = 0; row < FS_G2CAP_POINTS; row++)
    for (int w = 0; w < width; w++) {
      double sum = matrix[row * n] * net[w];
      for (int i = 0; i < 6 * k; i++) sum += matrix[row * n + 1 + i] * net[(1 + (6 * s + i) % (6 * k)) * width + w];
      points[row * width + w] = sum;
    }
}

/* x[10]: derivatives of the tensor patch points [(degree + 1)^2][3], u fastest. */
static inline void patch_jet(int degree, const double *points, double u, double v, fs_vec3 x[FS_JET_SIZE]) {
  static const int order_u[FS_JET_SIZE] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  static const int order_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};
  double U[4][10], V[4][10];
  for (int order = 0; order < 4; order++) {
    fs_bernstein_basis(degree, u, order, U[order]);
    fs_bernstein_basis(degree, v, order, V[order]);
  }
  for (int d = 0; d < FS_JET_SIZE; d++) {
    x[d] = (fs_vec3){0, 0, 0};
    for (int j = 0; j <= degree; j++)
      for (int i = 0; i <= degree; i++) {
        const double *p = points + 3 * (i + (degree + 1) * j);
        double factor = U[order_u[d]][i] * V[order_v[d]][j];
        x[d].x += factor * p[0], x[d].y += factor * p[1], x[d].z += factor * p[2];
      }
  }
}

/* points [16][3] of the face [a,a+1] x [b,b+1] of a sector, from the net of radius 3: a uniform bicubic B-spline. */
static inline int third_vertex(int k, int sector, int a, int b) {
  if (a == 0 && b == 0) return 0;
  if (b < 0) return third_vertex(k, sector - 1, -b, a);
  if (a <= 0) return third_vertex(k, sector + 1, b, -a);
  return 1 + 12 * ((sector + k) % k) + 3 * b + a - 1;
}
static inline void ring_patch(int k, int sector, int a, int b, const double *net, double *points) {
  static const double segment[4][4] = {{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++)
      for (int w = 0; w < 3; w++) {
        double sum = 0;
        for (int y = 0; y < 4; y++)
          for (int x = 0; x < 4; x++)
            if (segment[i][x] * segment[j][y] != 0) /* the face may lack vertices only where they do not matter */
              sum += segment[i][x] * segment[j][y] * net[3 * third_vertex(k, sector, a - 1 + x, b - 1 + y) + w];
        points[3 * (i + 4 * j) + w] = sum / 36;
      }
}

#endif
