/* SPDX-License-Identifier: MIT */
/* Linear constraints as one affine map: all dofs by fewer numbers. First symmetry and fixed dofs, c = c0 + B z (the base);
   then equations in z are solved for some of its numbers, which leaves the unknowns y. */
#ifndef FS_FAIR_CONSTRAIN_H
#define FS_FAIR_CONSTRAIN_H

#include <fairsurf/fair.h>
#include "fair/eliminate.h"
#include "fair/setup.h"

typedef struct fs_base {
  fs_vec3 *c;        /* [n_dofs] the start, exactly symmetric where that is asked for */
  bool *is_constant; /* [n_dofs] fixed, or image of a fixed dof */
  fs_reduction *map; /* rows: all dofs; columns: z */
  double *z;         /* [3 map->n_columns] z of the start */
  double size;       /* diagonal of the bounding box of the vertices */
} fs_base;

/* The base of symmetry and fixed dofs at the start c. */
fs_status fs_base_create(fs_context *ctx, const fs_space *space, const bool *fixed, const fs_symmetry *symmetry,
                         const fs_vec3 *c, fs_base *base);
void fs_base_free(fs_context *ctx, fs_base *base);

/* Makes the setup one in the unknowns that the holds, the equations and the base leave; *y[3 fs_setup_n]: where they begin,
   for the caller to release. Where the start does not meet the constraints it is deformed as little as the triharmonic energy
   of the displacement allows. */
fs_status fs_constrain_setup(fs_context *ctx, const fs_space *space, const fs_constraints *constraints,
                             const fs_base *base, fs_setup *setup, double **y);

/* Solves the holds and the equations for numbers of z. */
fs_status fs_constrain_solve(fs_context *ctx, const fs_space *space, const fs_constraints *constraints,
                             const fs_base *base, fs_elimination *elimination);

/* The map from y to the free dofs, row unknown[d] for dof d, and y of the start: numbers of z that are free stay as they are
   there. y[3 n_columns] is the caller's to release. */
fs_status fs_constrain_reduce(fs_context *ctx, const fs_space *space, const fs_base *base,
                              const fs_elimination *elimination, int32_t n_free, const int32_t *unknown,
                              fs_reduction **reduction, double **y);

/* Weights of the dofs of an element in its derivative of the given orders at (u, v): weight[n_dofs]. */
void fs_constrain_weights(const fs_extraction *extraction, double u, double v, int32_t order_u, int32_t order_v,
                          double *weight);

/* Rows of a map that grow one entry after another; columns are taken from map->n_columns on. */
typedef struct fs_map_builder {
  fs_context *ctx;
  fs_base *base;
  int32_t capacity, row; /* row: the one that is being made */
} fs_map_builder;
fs_status fs_map_add(fs_map_builder *builder, int32_t column, const double block[9]);
void fs_map_end_row(fs_map_builder *builder);

/* The rows of the inner coefficients of caps, which follow those of the vertices. */
fs_status fs_base_add_caps(fs_map_builder *builder, const fs_space *space, const bool *fixed,
                           const fs_symmetry *symmetry);

/* Orthonormal t[0], t[1] orthogonal to the unit vector n; exact axes where n is one. */
void fs_tangents(fs_vec3 n, fs_vec3 t[2]);

#endif
