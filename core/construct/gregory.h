/* SPDX-License-Identifier: MIT */
/* What the files of the Gregory construction share. */
#ifndef FS_CONSTRUCT_GREGORY_H
#define FS_CONSTRUCT_GREGORY_H

#include <fairsurf/construct.h>
#include "base/base.h"

/* How an edge or a corner is no place for a patch. */
typedef enum fs_gregory_fault {
  FS_GREGORY_FINE,
  FS_GREGORY_NO_LENGTH, /* the ends of the edge are one point */
  FS_GREGORY_ALONG_NORMAL,
  FS_GREGORY_REFLEX_START, /* the corner where the edge starts, as the face sees it */
  FS_GREGORY_REFLEX_END,
  FS_GREGORY_TURNS_OVER
} fs_gregory_fault;

/* The cubic over the edge from a to b with unit normals m and n: point[4]. */
fs_gregory_fault fs_gregory_edge(fs_vec3 a, fs_vec3 b, fs_vec3 m, fs_vec3 n, fs_edge_rule rule, fs_vec3 *point);

/* The field D(t) / 3 = k(t) b(t) + h(t) c'(t) / 3 across an edge, all factors linear. */
typedef struct fs_gregory_field {
  double k[2], h[2]; /* at both ends */
  fs_vec3 inner[2];  /* its middle two coefficients of four */
} fs_gregory_field;

/* edge: points of the cubic c, the face at its left; m, n: normals at its ends; first, last: the outer coefficients. */
fs_gregory_fault fs_gregory_cross(const fs_vec3 *edge, fs_vec3 m, fs_vec3 n, fs_vec3 first, fs_vec3 last,
                                  fs_gregory_field *field);

/* A patch as its points: corner[n_sides], normal[n_sides] anticlockwise; point[20] or point[18] in the order of
   fs_patch_kind. side: where the fault is. */
fs_gregory_fault fs_gregory_quad(const fs_vec3 *corner, const fs_vec3 *normal, const int32_t *number, fs_edge_rule rule,
                                 fs_vec3 *point, int32_t *side);
fs_gregory_fault fs_gregory_triangle(const fs_vec3 *corner, const fs_vec3 *normal, const int32_t *number,
                                     fs_edge_rule rule, fs_vec3 *point, int32_t *side);

/* The mesh of triangles and quads, and its normals: faces of more vertices become triangles around a new vertex.
   face: [n_faces] of the new mesh, the face of the old one. All NULL where there is nothing to split. */
fs_status fs_gregory_split(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, fs_mesh **split,
                           fs_vec3 **split_normal, int32_t **face);

#endif
