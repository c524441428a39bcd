/* SPDX-License-Identifier: MIT */
/* Single role: how far the numbers of a fairing can be trusted: S by a finer quadrature, and |p_u x p_v|, whose smallest value
   by its mean shows folds and slivers. Elements are measured in parallel and added in their order. */
#include <fairsurf/fair.h>
#include "base/base.h"
#include "fair/kernels.h"
#include "space/basis.h"

#include <math.h>

enum { NODES_SQUARE = 12, NODES_CAP = 24, MAX_NODES = 32, B = FS_BLOCK };

typedef struct element_quality {
  double S, area, least;
} element_quality;

typedef struct measurement {
  const fs_space *space;
  const fs_vec3 *c;
  fs_basis_table **table;   /* [n_extractions] */
  element_quality *element; /* [n_elements] */
  double **dofs;            /* [workers], one element's */
} measurement;

static void add_block(const fs_basis_table *table, int32_t block, const double *c, element_quality *e) {
  double x[FS_N_DERIVATIVES * 3 * B], f[B];
  const double *weight = table->weight + (size_t)block * B;
  const fs_kernels *kernels = fs_kernels_choose();
  kernels->jets(table->n_dofs, table->by_dof + (size_t)block * FS_N_DERIVATIVES * table->n_dofs * B, c, x);
  kernels->curvature_variation(x, f, NULL, NULL);
  for (int l = 0; l < B; l++) {
    const double *u = x + l, *v = x + 3 * B + l;
    double n0 = u[B] * v[2 * B] - u[2 * B] * v[B], n1 = u[2 * B] * v[0] - u[0] * v[2 * B],
           n2 = u[0] * v[B] - u[B] * v[0], area = sqrt(n0 * n0 + n1 * n1 + n2 * n2);
    if (weight[l] == 0) continue; /* beyond the last point */
    e->S += weight[l] * f[l];
    e->area += weight[l] * area;
    e->least = fmin(e->least, area);
  }
}

static fs_status measure_elements(void *user, int32_t begin, int32_t end, int32_t worker) {
  measurement *m = user;
  double *c = m->dofs[worker];
  for (int32_t i = begin; i < end; i++) {
    const fs_element *e = &m->space->element[i];
    const fs_basis_table *table = m->table[e->extraction];
    for (int32_t d = 0; d < table->n_dofs; d++) {
      fs_vec3 p = m->c[m->space->dof[e->dof_start + d]];
      c[3 * d] = p.x;
      c[3 * d + 1] = p.y;
      c[3 * d + 2] = p.z;
    }
    m->element[i] = (element_quality){.least = INFINITY};
    for (int32_t block = 0; block < table->n_blocks; block++) add_block(table, block, c, &m->element[i]);
  }
  return FS_OK;
}

static fs_quality sum_up(const measurement *m, int32_t square, int32_t cap) {
  fs_quality q = {.n_nodes_square = square, .n_nodes_cap = cap, .face = FS_NONE};
  double least = INFINITY;
  for (int32_t i = 0; i < m->space->n_elements; i++) {
    const element_quality *e = &m->element[i];
    q.S += e->S;
    q.area += e->area;
    if (m->space->extraction[m->space->element[i].extraction].valence != 4) q.S_caps += e->S;
    if (e->least < least) {
      least = e->least;
      q.face = m->space->element[i].face;
    }
  }
  q.least_density = q.area > 0 ? least * m->space->n_elements / q.area : 0;
  return q;
}

fs_status fs_fair_quality(fs_context *ctx, const fs_space *space, const fs_vec3 *c, int32_t n_nodes_square,
                          int32_t n_nodes_cap, fs_quality *quality) {
  fs_status status = FS_OK;
  int32_t square = n_nodes_square == 0 ? NODES_SQUARE : n_nodes_square;
  int32_t cap = n_nodes_cap == 0 ? NODES_CAP : n_nodes_cap, n_workers = fs_n_workers(ctx), most = 0;
  measurement m = {.space = space, .c = c};
  if (square < 1 || square > MAX_NODES || cap < 1 || cap > MAX_NODES)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d nodes on squares and %d in caps: 1 to %d are possible", square, cap,
                   MAX_NODES);
  FS_ALLOC(ctx, m.table, space->n_extractions);
  for (int32_t i = 0; i < space->n_extractions; i++) {
    const fs_extraction *x = &space->extraction[i];
    FS_TRY(fs_basis_create(ctx, x, x->valence == 4 ? square : cap, &m.table[i]));
    if (x->n_dofs > most) most = x->n_dofs;
  }
  FS_ALLOC(ctx, m.element, space->n_elements);
  FS_ALLOC(ctx, m.dofs, n_workers);
  for (int32_t w = 0; w < n_workers; w++) FS_ALLOC(ctx, m.dofs[w], 3 * (size_t)most);
  FS_TRY(fs_parallel_for(ctx, space->n_elements, measure_elements, &m));
  *quality = sum_up(&m, square, cap);
done:
  for (int32_t i = 0; m.table != NULL && i < space->n_extractions; i++) fs_basis_free(ctx, m.table[i]);
  for (int32_t w = 0; m.dofs != NULL && w < n_workers; w++) fs_release(ctx, m.dofs[w]);
  fs_release(ctx, m.table);
  fs_release(ctx, m.element);
  fs_release(ctx, m.dofs);
  return status;
}
