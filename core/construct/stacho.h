/* SPDX-License-Identifier: MIT */
/* What the files of Stacho's triangles share. For corner or edge k, i = k + 1 and j = k + 2 (mod 3); edge k lies opposite
   corner k. */
#ifndef FS_CONSTRUCT_STACHO_H
#define FS_CONSTRUCT_STACHO_H

#include <fairsurf/construct_stacho.h>
#include "base/base.h"

/* What a triangle is made from; heights (width 1) and points (width 3) alike. */
typedef struct fs_stacho_corners {
  int32_t width;
  double p[3][3];       /* [corner][component] value */
  double g[3][3][3];    /* [i][j]: derivative at corner i along the edge to j, i != j */
  double h[3][3][3][3]; /* [i][a][b]: second derivative at corner i along the edges to a and to b */
  double alpha[3];      /* [k]: the direction across edge k is e_k - alpha e_i - (1 - alpha) e_j in barycentrics */
} fs_stacho_corners;

enum { FS_STACHO_MAX_DEGREE = 7, FS_STACHO_MAX_POINTS = 36 };

int32_t fs_stacho_degree(fs_stacho_variant variant);

/* c[(n + 1)(n + 2) / 2][width]: Bernstein coefficients of the triangle of degree n = fs_stacho_degree. */
void fs_stacho_bezier(const fs_stacho_corners *corners, fs_stacho_variant variant, double *c);

/* The same with shape functions; their degree is fs_stacho_shape_degree, at most FS_MAX_TRIANGLE_DEGREE. */
int32_t fs_stacho_shape_degree(const fs_stacho_shape *shape);
void fs_stacho_shaped_bezier(const fs_stacho_corners *corners, const fs_stacho_shape *shape, double *c);

/* A triangle on one side of an inner edge. */
typedef struct fs_stacho_half {
  int32_t face, side; /* side s runs from its corner s to s + 1 */
  double *numbers;    /* of its patch: control points, and blocks of its sides (surface/stacho.h) */
} fs_stacho_half;

/* Fills the blocks of both triangles of degree n at their common edge, between vertices a and b. fixed: the direction of
   the correction, or NULL. */
fs_status fs_stacho_correct(fs_context *ctx, int32_t n, const fs_stacho_half half[2], int32_t a, int32_t b,
                            const double *fixed);

extern const fs_stacho_shape fs_stacho_quintic; /* the one of FS_STACHO_QUINTIC */

#endif
