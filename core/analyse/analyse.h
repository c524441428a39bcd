/* SPDX-License-Identifier: MIT */
/* What the files of this room share. */
#ifndef FS_ANALYSE_ANALYSE_H
#define FS_ANALYSE_ANALYSE_H

#include <fairsurf/analyse.h>
#include "analyse/integrands.h"
#include "base/base.h"

/* Part of a side of a patch: its points from parameter begin to end of the side, begin < end. */
typedef struct fs_stretch {
  int32_t patch, side;
  double begin, end;
} fs_stretch;

/* Derivatives at parameter t of a side. */
fs_place fs_side_place(const fs_surface *surface, int32_t patch, int32_t side, double t);
void fs_side_evaluate(const fs_surface *surface, int32_t patch, int32_t side, double t, fs_vec3 x[FS_JET_SIZE]);

/* The parameter in [from, to] (in any order) of the point of a side that is closest to a point, started at t.
   Returns the distance. */
double fs_side_closest(const fs_surface *surface, int32_t patch, int32_t side, double from, double to, fs_vec3 point,
                       double *t);

/* Edges among stretches of sides without neighbours, found by geometry (edges_match.c). */
typedef struct fs_matches {
  int32_t n;
  fs_edge *edge; /* [n] without vertices; then the stretches that meet nothing: */
  int32_t n_left;
  fs_stretch *left; /* [n_left] */
} fs_matches;
fs_status fs_edges_match(fs_context *ctx, const fs_surface *surface, int32_t n, const fs_stretch *side,
                         double tolerance, fs_matches *matches);
void fs_matches_clear(fs_context *ctx, fs_matches *matches);

/* ---- shape ---- */

/* What is looked for all over a surface (extremes.c). */
typedef enum fs_extreme {
  FS_MOST_H,
  FS_LEAST_H,
  FS_MOST_K,
  FS_LEAST_K,
  FS_MOST_GRADIENT,
  FS_LEAST_GRADIENT,
  FS_MOST_PRINCIPAL,
  FS_LEAST_PRINCIPAL,
  FS_LEAST_AREA, /* |p_u x p_v| */
  FS_N_EXTREMES
} fs_extreme;

/* A value and where it is; NAN: none. "Least" values are stored as they are. */
typedef struct fs_found {
  double value, u, v;
} fs_found;

/* What the derivatives at a point say for each, and keeps those that are better than found[FS_N_EXTREMES]. */
typedef struct fs_point_values {
  double value[FS_N_EXTREMES]; /* NAN where p_u x p_v = 0, but for the area */
} fs_point_values;
void fs_point_evaluate(const fs_vec3 x[FS_JET_SIZE], fs_point_values *values);
bool fs_extreme_is_better(fs_extreme e, double a, double b); /* a than b; NAN is worse than anything */

/* Follows an extreme from a point of a patch to a local one, in the domain of the patch, steps at first of that size. Points
   with |p_u x p_v| below least_area do not count, but for that itself: near singular points curvatures are rounding errors. */
void fs_extreme_follow(const fs_surface *surface, int32_t patch, fs_extreme e, double step, double least_area,
                       fs_found *found);

/* Integrals over one patch (shape_patch.c). */
typedef struct fs_patch_shape {
  double integral[FS_N_INTEGRALS], error[FS_N_INTEGRALS];
  fs_found found[FS_N_EXTREMES]; /* at the nodes of the first pass */
} fs_patch_shape;

/* A point of the first pass, with the area it stands for. */
typedef struct fs_sample {
  double H, K, gradient, area;
} fs_sample;

/* Gauss nodes per direction of a patch. */
int32_t fs_patch_nodes(const fs_patch *patch);

/* Nodes and weights of all those numbers, the multiples of 8. */
typedef struct fs_rules {
  double node[FS_MAX_PATCH_NODES + 1][FS_MAX_PATCH_NODES], weight[FS_MAX_PATCH_NODES + 1][FS_MAX_PATCH_NODES];
  double legendre[FS_MAX_PATCH_NODES + 1][2][FS_MAX_PATCH_NODES]; /* weights of the two highest coefficients */
} fs_rules;
fs_status fs_rules_create(fs_context *ctx, fs_rules **rules);

/* tolerance[FS_N_INTEGRALS]: wanted errors relative to the integrals of the patch. Every stride-th node from the given first
   one goes to sample; n_samples: how many did. */
void fs_patch_measure(const fs_surface *surface, int32_t patch, const fs_rules *rules, const double *tolerance,
                      int32_t first, int32_t stride, fs_patch_shape *shape, fs_sample *sample, int32_t *n_samples);

/* Percentiles by area (distribution.c); the order of sample changes. */
void fs_distribution_percentiles(size_t n, fs_sample *sample, fs_distribution *H, fs_distribution *K,
                                 fs_distribution *gradient);

/* Largest distance of two points (diameter.c). */
fs_status fs_surface_diameter(fs_context *ctx, const fs_surface *surface, double *diameter, fs_place end[2]);

/* Whether two triangles cut each other, or seem to because they touch, and a point of both (triangle_pair.c). */
bool fs_triangles_cut(const fs_vec3 s[3], const fs_vec3 t[3], fs_vec3 *point);

#endif
