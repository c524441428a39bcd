/* SPDX-License-Identifier: MIT */
/* Displacements of coarse meshes as unknowns. */
#ifndef FS_FAIR_COARSE_H
#define FS_FAIR_COARSE_H

#include "fair/problem.h"

enum { FS_MAX_COARSE = 8 };

/* Reductions x = x0 + P y of the free dofs of a problem, P the product of the refinement matrices between a coarser mesh and
   this one, the finest of them first: reduction[i] is the mesh i + 1 refinements before. Coarse vertices whose own vertex in
   the mesh is free are the unknowns, and dofs beyond the vertices stay as they are. Stops where fewer than least unknowns
   would remain, or where the connectivity is that of no refinement. x0 is zero; the caller frees them. */
fs_status fs_coarse_create(fs_context *ctx, const fs_problem *problem, const fs_mesh *mesh, int32_t least,
                           fs_reduction *reduction[FS_MAX_COARSE], int32_t *n);

#endif
