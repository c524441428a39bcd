/* SPDX-License-Identifier: MIT */
/* What exporters for solid modelling and for printing need to know about triangles: their rim, their volume, their faults. */
#ifndef FS_EXPORTERS_SOLID_H
#define FS_EXPORTERS_SOLID_H

#include <fairsurf/surface.h>

/* Boundary of triangles: closed loops, the surface at the left of each edge seen from outside. */
typedef struct fs_rim {
  int32_t n_loops, n_vertices;
  int32_t *start;  /* [n_loops + 1]: loop i is vertex[start[i]] .. vertex[start[i + 1] - 1] */
  int32_t *vertex; /* [n_vertices] */
} fs_rim;
fs_status fs_rim_create(fs_context *ctx, const fs_triangles *t, fs_rim **rim);
void fs_rim_free(fs_context *ctx, fs_rim *rim); /* NULL is allowed */

/* Volume inside closed triangles; negative where they are inside out. */
double fs_triangles_volume(const fs_triangles *t);

/* A triangle without area (less than 1e-12 of its longest side squared), or FS_NONE; and the shortest side of all. */
int32_t fs_triangles_flat(const fs_triangles *t, double *shortest);

#endif
