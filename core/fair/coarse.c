/* SPDX-License-Identifier: MIT */
/* Single role: the hierarchy of coarse displacements over a mesh that is a refinement. Only free vertices move, so that rims
   and marks stay, and no coarse surface is needed: the functional is that of the fine surface at x0 + P y. */
#include "fair/coarse.h"
#include "fair/coarse_squares.h"
#include "refine/refine.h"

#include <string.h>

/* What is known at one level. */
typedef struct level {
  fs_mesh *mesh;   /* NULL: the mesh of the problem */
  int32_t *origin; /* [its n_vertices] the vertex in the mesh of the problem */
  fs_stencils P;   /* rows: vertices of the mesh of the problem */
} level;

static void level_release(fs_context *ctx, level *l) {
  fs_mesh_free(ctx, l->mesh);
  fs_release(ctx, l->origin);
  fs_stencils_release(ctx, &l->P);
  *l = (level){0};
}

/* The next coarser level; its mesh is NULL where there is none. */
static fs_status coarsen(fs_context *ctx, const fs_mesh *mesh, const level *fine, level *coarse) {
  fs_status status = FS_OK;
  level l = {0};
  fs_stencils step = {0};
  FS_TRY(fs_mesh_coarsen(ctx, fine->mesh != NULL ? fine->mesh : mesh, &l.mesh, &step, &l.origin));
  if (l.mesh == NULL) goto done;
  if (fine->mesh != NULL) {
    FS_TRY(fs_stencils_multiply(ctx, &fine->P, &step, &l.P));
    for (int32_t i = 0; i < l.mesh->n_vertices; i++) l.origin[i] = fine->origin[l.origin[i]];
  } else {
    l.P = step;
    step = (fs_stencils){0};
  }
  *coarse = l;
  l = (level){0};
done:
  fs_stencils_release(ctx, &step);
  level_release(ctx, &l);
  return status;
}

/* number[P.n_columns] = the unknown of a coarse vertex, or FS_NONE; how many there are. */
static int32_t number_unknowns(const fs_problem *p, const level *l, int32_t *number) {
  int32_t n = 0;
  for (int32_t i = 0; i < l->P.n_columns; i++) number[i] = p->unknown[l->origin[i]] != FS_NONE ? n++ : FS_NONE;
  return n;
}

static fs_status make_reduction(fs_context *ctx, const fs_problem *p, const level *l, const int32_t *number,
                                int32_t n_coarse, fs_reduction **reduction) {
  fs_status status = FS_OK;
  fs_reduction *r = NULL;
  const fs_stencils *P = &l->P;
  int32_t n_vertices = P->n_rows, n_more = 0, n = 0;
  FS_ALLOC(ctx, r, 1);
  for (int32_t d = n_vertices; d < p->space->n_dofs; d++) n_more += p->unknown[d] != FS_NONE;
  r->n_rows = p->n_free;
  r->n_columns = n_coarse + n_more;
  FS_ALLOC(ctx, r->row_start, (size_t)r->n_rows + 1);
  FS_ALLOC(ctx, r->column, (size_t)P->start[n_vertices] + (size_t)n_more);
  FS_ALLOC(ctx, r->weight, (size_t)P->start[n_vertices] + (size_t)n_more);
  FS_ALLOC(ctx, r->x0, 3 * (size_t)r->n_rows);
  for (int32_t d = 0, next = n_coarse; d < p->space->n_dofs; d++) {
    if (p->unknown[d] == FS_NONE) continue;
    if (d >= n_vertices) {
      r->column[n] = next++;
      r->weight[n++] = 1;
    }
    for (int32_t k = d < n_vertices ? P->start[d] : 0; d < n_vertices && k < P->start[d + 1]; k++) {
      if (number[P->column[k]] == FS_NONE) continue;
      r->column[n] = number[P->column[k]];
      r->weight[n++] = P->weight[k];
    }
    r->row_start[p->unknown[d] + 1] = n; /* unknowns ascend with their dofs */
  }
  *reduction = r;
  r = NULL;
done:
  fs_reduction_free(ctx, r);
  return status;
}

fs_status fs_coarse_create(fs_context *ctx, const fs_problem *p, const fs_mesh *mesh, int32_t least,
                           fs_reduction *reduction[FS_MAX_COARSE], int32_t *n) {
  fs_status status = FS_OK;
  level fine = {0}, coarse = {0};
  int32_t *number = NULL;
  *n = 0;
  while (*n < FS_MAX_COARSE) {
    int32_t n_unknowns;
    FS_TRY(coarsen(ctx, mesh, &fine, &coarse));
    if (coarse.mesh == NULL) break;
    fs_release(ctx, number);
    number = NULL;
    FS_ALLOC(ctx, number, coarse.P.n_columns);
    n_unknowns = number_unknowns(p, &coarse, number);
    if (n_unknowns < least) break;
    FS_TRY(make_reduction(ctx, p, &coarse, number, n_unknowns, &reduction[*n]));
    ++*n;
    FS_TRY(fs_coarse_squares_find(p, mesh, coarse.mesh, *n, coarse.origin, number, reduction[*n - 1],
                                  &reduction[*n - 1]->squares));
    level_release(ctx, &fine);
    fine = coarse;
    coarse = (level){0};
  }
done:
  if (status != FS_OK)
    while (*n > 0) fs_reduction_free(ctx, reduction[--*n]);
  fs_release(ctx, number);
  level_release(ctx, &fine);
  level_release(ctx, &coarse);
  return status;
}
