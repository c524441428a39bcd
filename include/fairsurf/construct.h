/* SPDX-License-Identifier: MIT */
/* Surfaces made directly, without fairing: patches from curves, normals and given patches [docs/patches.md]. */
#ifndef FAIRSURF_CONSTRUCT_H
#define FAIRSURF_CONSTRUCT_H

#include <fairsurf/mesh.h>
#include <fairsurf/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the table ------------------------------------------------------------------------------------------------------ */

/* What a construction starts from; a part that it does not use may be NULL. */
typedef struct fs_construction_input {
  const fs_mesh *mesh;
  const fs_vec3 *normal; /* [n_vertices] of the mesh, unit vectors to the outside; NULL: fs_vertex_normals */
} fs_construction_input;

/* A construction. Lines of a table. */
typedef struct fs_construction {
  const char *name, *summary;
  const fs_param *params;
  fs_status (*build)(fs_context *ctx, const fs_construction_input *input, const double *param, fs_surface **surface);
} fs_construction;
FS_API extern const fs_construction *const fs_constructions[];        /* ends with NULL: gregory */
FS_API const fs_construction *fs_construction_find(const char *name); /* NULL: unknown */

/* Builds with param, or the initial values of the construction's params where param is NULL. */
FS_API fs_status fs_construct(fs_context *ctx, const fs_construction *construction, const fs_construction_input *input,
                              const double *param, fs_surface **surface);

/* ---- Gregory patches ------------------------------------------------------------------------------------------------ */

/* normal[n_vertices]: sums of the normals of the corners (next - v) x (previous - v), each as long as its angle, made unit
   vectors. Corners whose edges span no plane add nothing; FS_ERR_NUMERIC names a vertex where the sum is zero. */
FS_API fs_status fs_vertex_normals(fs_context *ctx, const fs_mesh *mesh, fs_vec3 *normal);

/* How long the tangents of the cubic over an edge are. With d the edge, p its projection on the tangent plane of an end: */
typedef enum fs_edge_rule {
  FS_EDGE_ARC, /* along p, as the cubic that stands for a circular arc has them: 2 |d| / (3 (1 + |p| / |d|)) */
  FS_EDGE_PN,  /* p / 3 [Vlachos Peters Boyd Mitchell 2001] */
  FS_EDGE_WM   /* [Walton Meek 1996] */
} fs_edge_rule;

/* Interpolates the vertices of a mesh and their normals by a surface with one tangent plane everywhere (G1): a Gregory quad
   or triangle for each face of 4 or 3 vertices, their sides cubics that depend on the edge and its two normals only. A face
   of more vertices is split into triangles around a new vertex, on the mean of the arcs that start at its corners; its
   patches follow each other. fs_patch.face is the face of the mesh. normal: [n_vertices], or NULL: fs_vertex_normals.
   FS_ERR_NUMERIC names an edge of no length, an edge along the normal of its end, a corner whose edges, seen along its
   normal, turn clockwise or by no angle (a reflex corner), an edge along which the tangent plane turns over, and a normal
   that is no unit vector. */
FS_API fs_status fs_gregory_create(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, fs_edge_rule rule,
                                   fs_surface **surface);

#ifdef __cplusplus
}
#endif
#endif
