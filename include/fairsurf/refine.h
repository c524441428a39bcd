/* SPDX-License-Identifier: MIT */
/* Refinement: a finer mesh whose vertices are fixed linear combinations of the old ones. */
#ifndef FAIRSURF_REFINE_H
#define FAIRSURF_REFINE_H

#include <fairsurf/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The finer mesh and its matrix: position of fine vertex i = sum of weight[j] * old position column[j] over
   j = row_start[i] .. row_start[i + 1] - 1. Weights of a row sum to 1; columns ascend. */
typedef struct fs_refinement {
  fs_mesh *mesh;
  int32_t n_coarse;   /* vertices of the old mesh */
  int32_t *row_start; /* [mesh->n_vertices + 1] */
  int32_t *column;    /* [row_start[mesh->n_vertices]] */
  double *weight;     /* the same size */
} fs_refinement;

/* A way to refine. Lines of a table. */
typedef struct fs_refiner {
  const char *name, *summary;
  const fs_param *params;
  fs_status (*refine)(fs_context *ctx, const fs_mesh *mesh, const double *param, fs_refinement **refinement);
} fs_refiner;
FS_API extern const fs_refiner *const fs_refiners[]; /* ends with NULL: averaging, catmull-clark */

/* Refines once with the refiner of that name. param NULL: initial values of its params.
   averaging: every vertex, edge and face is doubled into a face, then the mesh is replaced n times by its dual
   (vertices = centroids of faces), n = 1 .. 16, 3 by default [Lane Riesenfeld 1980, on meshes]. n odd: special elements
   end up as vertices; n even: as faces. Each dual loses one ring of faces at the boundary; n = 3 gives the Catmull-Clark
   mesh without the faces that touch its boundary. Needs interior valences of 3 or more (else FS_ERR_UNSUPPORTED).
   catmull-clark: [Catmull Clark 1978], boundary curves refined as cubic B-splines. */
FS_API fs_status fs_mesh_refine(fs_context *ctx, const fs_mesh *mesh, const char *name, const double *param,
                                fs_refinement **refinement);
FS_API void fs_refinement_free(fs_context *ctx, fs_refinement *refinement); /* frees the mesh too; NULL is allowed */

/* fine[i] = true when all old vertices of the row of i with a weight other than zero are marked.
   coarse[n_coarse], fine[mesh->n_vertices]. */
FS_API void fs_refinement_marks(const fs_refinement *refinement, const bool *coarse, bool *fine);

/* fine = matrix * coarse, for new positions of the old vertices. coarse[n_coarse], fine[mesh->n_vertices]. */
FS_API void fs_refinement_apply(const fs_refinement *refinement, const fs_vec3 *coarse, fs_vec3 *fine);

#ifdef __cplusplus
}
#endif
#endif
