/* SPDX-License-Identifier: MIT */
/* What the refiners share: rows of weights and their products, the split of a mesh into one quadrilateral per corner. */
#ifndef FS_REFINE_REFINE_H
#define FS_REFINE_REFINE_H

#include <fairsurf/refine.h>
#include "base/base.h"
#include "mesh/mesh.h"

extern const fs_refiner fs_refiner_averaging;
extern const fs_refiner fs_refiner_catmull_clark;

/* A sparse matrix by rows: row i holds weight[j] in column[j], j = start[i] .. start[i + 1] - 1. All zero: empty. */
typedef struct fs_stencils {
  int32_t n_rows, n_columns;
  int32_t *start;  /* [n_rows + 1] */
  int32_t *column; /* [start[n_rows]] */
  double *weight;  /* the same size */
} fs_stencils;

/* Zeroed arrays for n_entries entries; start is for the caller to fill. Frees itself on failure. */
fs_status fs_stencils_allocate(fs_context *ctx, int32_t n_rows, int32_t n_columns, int32_t n_entries,
                               fs_stencils *stencils);
void fs_stencils_release(fs_context *ctx, fs_stencils *stencils);

/* product = left right. Equal columns of a row are added up; columns come in any order. Replaces nothing on failure. */
fs_status fs_stencils_multiply(fs_context *ctx, const fs_stencils *left, const fs_stencils *right,
                               fs_stencils *product);

/* Puts the columns of every row in ascending order, in linear time. */
fs_status fs_stencils_sort(fs_context *ctx, fs_stencils *stencils);

/* Splits every face into one quadrilateral per corner. Vertices of the result: those of mesh, then one per edge, then one
   per face. Face h belongs to half-edge h of mesh and runs (origin of h, edge of h, face of h, edge of previous h).
   Positions stay zero. edge[n_halfedges] is the vertex of the edge of each half-edge. The caller frees both. */
fs_status fs_mesh_split(fs_context *ctx, const fs_mesh *mesh, fs_mesh **split, int32_t **edge);

/* The rows of the vertices of that mesh: the vertex itself, the midpoint of its edge, the centroid of its face. */
fs_status fs_mesh_split_stencils(fs_context *ctx, const fs_mesh *mesh, const fs_mesh *split, const int32_t *edge,
                                 fs_stencils *stencils);

/* Makes a refinement of a mesh without positions and its rows, sorts them and sets the positions.
   Takes over *fine and *stencils, which are empty afterwards, on success only. */
fs_status fs_refinement_assemble(fs_context *ctx, const fs_mesh *coarse, fs_mesh **fine, fs_stencils *stencils,
                                 fs_refinement **refinement);

/* The mesh of which this one may be a refinement, going by the connectivity alone, and the rows of three averagings; its
   vertices keep their positions in the fine mesh, where vertex i is origin[i]. *coarse is NULL, and nothing else is set,
   where there is none. Rows are empty for fine vertices at the rim; near it they leave out old vertices that are no longer
   there, so that they sum to less than 1. The caller frees all three. */
fs_status fs_mesh_coarsen(fs_context *ctx, const fs_mesh *fine, fs_mesh **coarse, fs_stencils *stencils,
                          int32_t **origin);

#endif
