/* SPDX-License-Identifier: MIT */
/* Single role: displacements along normals. The normal at dof k is the direction of

     dV/dc_k = integral of N_k n dM,

   the mean normal of the surface where the dof acts, V the volume under the surface: it needs no mesh. Three dofs that are
   coupled share a group of unknowns, so that the system has a third of the rows. Steps along fixed normals end at a point from
   which others lead farther; the normals are refreshed after every few of them. */
#include "fair/along_normals.h"

#include <math.h>
#include <string.h>

/* column[n] = group * 3 + place of each free dof; returns how many groups there are. Neighbours go together. */
static int32_t make_groups(const fs_sparse *pattern, int32_t *column) {
  int32_t n_groups = 0;
  for (int32_t i = 0; i < pattern->n_blocks; i++) column[i] = FS_NONE;
  for (int32_t i = 0; i < pattern->n_blocks; i++) {
    int32_t n = 0;
    for (int32_t e = pattern->col_start[i]; column[i] == FS_NONE || (n > 0 && n < 3); e++) {
      if (e == pattern->col_start[i + 1]) break;
      if (column[pattern->row[e]] == FS_NONE) column[pattern->row[e]] = 3 * n_groups + n++;
    }
    n_groups += n > 0;
  }
  return n_groups;
}

fs_status fs_along_normals_create(fs_setup *s, fs_reduction **reduction) {
  fs_status status = FS_OK;
  fs_context *ctx = s->problem->ctx;
  int32_t n = s->problem->n_free;
  fs_reduction *r = NULL;
  if (s->normals == NULL) FS_TRY(fs_volume_create(s->problem, &s->normals));
  FS_ALLOC(ctx, r, 1);
  r->n_rows = n;
  FS_ALLOC(ctx, r->row_start, n + 1);
  FS_ALLOC(ctx, r->column, n);
  FS_ALLOC(ctx, r->block, 9 * (size_t)n);
  FS_ALLOC(ctx, r->x0, 3 * (size_t)n);
  r->n_columns = make_groups(s->problem->pattern, r->column);
  FS_ALLOC(ctx, r->is_idle, 3 * (size_t)r->n_columns);
  memset(r->is_idle, true, 3 * (size_t)r->n_columns * sizeof *r->is_idle);
  for (int32_t i = 0; i < n; i++) {
    int32_t place = r->column[i] % 3;
    r->is_idle[r->column[i]] = false;
    r->row_start[i + 1] = i + 1;
    r->column[i] /= 3;
    r->block[9 * (size_t)i + (size_t)place] = 1; /* tells the place until there are normals */
  }
  *reduction = r;
  r = NULL;
done:
  fs_reduction_free(ctx, r);
  return status;
}

fs_status fs_along_normals_turn(fs_setup *s, const double *x) {
  fs_status status = FS_OK;
  fs_reduction *r = s->reduction;
  size_t n = 3 * (size_t)r->n_rows;
  double volume;
  fs_problem_set(s->problem, x);
  memset(s->g, 0, n * sizeof *s->g);
  FS_TRY(fs_volume_evaluate(s->normals, FS_GRADIENT, 1, &volume, s->g, NULL));
  memcpy(r->x0, x, n * sizeof *x);
  for (int32_t i = 0; i < r->n_rows; i++) {
    double *block = r->block + 9 * (size_t)i, *v = s->g + 3 * (size_t)i;
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    int place = block[0] != 0 || block[3] != 0 || block[6] != 0   ? 0
                : block[1] != 0 || block[4] != 0 || block[7] != 0 ? 1
                                                                  : 2;
    if (!(length > 0)) continue; /* keeps the one it has */
    for (int a = 0; a < 3; a++) block[3 * a + place] = v[a] / length;
  }
done:
  return status;
}
