/* SPDX-License-Identifier: MIT */
/* What the files of this room share. */
#ifndef FS_ANALYSE_ANALYSE_H
#define FS_ANALYSE_ANALYSE_H

#include <fairsurf/analyse.h>
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

#endif
