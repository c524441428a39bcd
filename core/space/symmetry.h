/* SPDX-License-Identifier: MIT */
/* What the search for a plane of symmetry, its check and its use in fairing share. */
#ifndef FS_SPACE_SYMMETRY_H
#define FS_SPACE_SYMMETRY_H

#include <fairsurf/space.h>
#include "base/base.h"

/* Vertices in the order of a key, for finding them by position. */
typedef struct fs_keyed_vertex {
  double key;
  int32_t vertex;
} fs_keyed_vertex;
fs_status fs_sorted_vertices_create(fs_context *ctx, const fs_mesh *mesh, fs_keyed_vertex **sorted);

double fs_symmetry_tolerance(const fs_mesh *mesh); /* 1e-6 of the diagonal of the bounding box */

fs_vec3 fs_plane_reflect(fs_vec3 normal, double offset, fs_vec3 p);

/* image[n_vertices] by position within tolerance, an involution; the first vertex without one, or FS_NONE. */
int32_t fs_plane_map_vertices(const fs_mesh *mesh, const fs_keyed_vertex *sorted, fs_vec3 normal, double offset,
                              double tolerance, int32_t *image);

/* halfedge[n_halfedges] by the images of vertices; the first face without an image, or FS_NONE. */
int32_t fs_plane_map_halfedges(const fs_mesh *mesh, const int32_t *vertex, int32_t *halfedge);

/* A plane about which the mesh is symmetric. */
fs_status fs_symmetry_find(fs_context *ctx, const fs_mesh *mesh, fs_vec3 *normal, double *offset);

/* Of two vertices that are images of each other one is the first; a vertex on the plane is the first of itself. */
static inline bool fs_symmetry_is_first(const fs_symmetry *s, int32_t vertex) { return vertex <= s->vertex[vertex]; }

/* first[n_caps]: the element of sector 0 of each cap; those of its other sectors follow. */
void fs_cap_elements(const fs_space *space, int32_t *first);

/* How the inner coefficients of a cap and of its image correspond: those of the image are M times the mirror images of those
   of the cap; matrix[n_dofs][n_dofs] of the cap. The functions of both caps span the same space, but their bases are no mirror
   images of each other: M is found from the Bezier points, and is orthogonal. first: of fs_cap_elements. */
fs_status fs_symmetry_cap(fs_context *ctx, const fs_space *space, const fs_symmetry *symmetry, const int32_t *first,
                          int32_t cap, int32_t image, double *matrix);

#endif
