/* SPDX-License-Identifier: MIT */
/* Single role: tables, unknowns, pattern and buffers of a problem. */
#include "fair/problem.h"
#include "fair/assemble.h"
#include "fair/coarse_squares.h"

#include <string.h>

enum { MAX_BATCH = 256, BATCH_BYTES = 32 << 20 };

static fs_status number_unknowns(fs_context *ctx, fs_problem *p, const bool *fixed) {
  fs_status status = FS_OK;
  bool *used = NULL; /* dofs that no element sees cannot be determined: they stay */
  FS_ALLOC(ctx, p->unknown, p->space->n_dofs);
  FS_ALLOC(ctx, used, p->space->n_dofs);
  for (int64_t i = 0; i < p->space->n_element_dofs; i++) used[p->space->dof[i]] = true;
  for (int32_t d = 0; d < p->space->n_dofs; d++)
    p->unknown[d] = used[d] && (fixed == NULL || !fixed[d]) ? p->n_free++ : FS_NONE;
done:
  fs_release(ctx, used);
  return status;
}

fs_status fs_problem_sets(fs_problem *p, int64_t **set_start, int32_t **set_member) {
  fs_status status = FS_OK;
  const fs_space *space = p->space;
  int64_t *start = NULL;
  int32_t *member = NULL;
  FS_ALLOC(p->ctx, start, (size_t)space->n_elements + 1);
  FS_ALLOC(p->ctx, member, space->n_element_dofs);
  for (int32_t i = 0; i < space->n_elements; i++)
    start[i + 1] = start[i] + space->extraction[space->element[i].extraction].n_dofs;
  for (int64_t i = 0; i < space->n_element_dofs; i++) member[i] = p->unknown[space->dof[i]];
  *set_start = start;
  *set_member = member;
  start = NULL;
  member = NULL;
done:
  fs_release(p->ctx, start);
  fs_release(p->ctx, member);
  return status;
}

static fs_status make_pattern(fs_context *ctx, fs_problem *p) {
  fs_status status = FS_OK;
  int64_t *start = NULL;
  int32_t *member = NULL;
  FS_TRY(fs_problem_sets(p, &start, &member));
  FS_TRY(fs_sparse_create(ctx, p->n_free, p->space->n_elements, start, member, &p->pattern));
done:
  fs_release(ctx, start);
  fs_release(ctx, member);
  return status;
}

static fs_status make_buffers(fs_context *ctx, fs_problem *p) {
  fs_status status = FS_OK;
  size_t largest = 0;
  int32_t n_workers = fs_n_workers(ctx);
  for (int32_t i = 0; i < p->space->n_extractions; i++)
    if ((size_t)p->table[i]->n_padded > largest) largest = (size_t)p->table[i]->n_padded;
  p->n_largest = p->n_listed = largest;
  size_t bytes = (6 * largest + 3) * largest * sizeof(double);
  p->n_batch = (int32_t)(BATCH_BYTES / bytes);
  if (p->n_batch < 1) p->n_batch = 1;
  if (p->n_batch > MAX_BATCH) p->n_batch = MAX_BATCH;
  if (p->n_batch > p->space->n_elements) p->n_batch = p->space->n_elements;
  FS_ALLOC(ctx, p->result, p->n_batch);
  for (int32_t i = 0; i < p->n_batch; i++) {
    FS_ALLOC(ctx, p->result[i].gradient, 3 * largest);
    FS_ALLOC(ctx, p->result[i].hessian, 6 * largest * largest);
    FS_ALLOC(ctx, p->result[i].list, largest);
    FS_ALLOC(ctx, p->result[i].place, largest);
  }
  FS_ALLOC(ctx, p->scratch, n_workers);
  FS_ALLOC(ctx, p->work, n_workers);
  for (int32_t i = 0; i < n_workers; i++) {
    p->scratch[i] = fs_allocate(ctx, 1, fs_assemble_scratch_size());
    if (p->scratch[i] == NULL) {
      status = FS_ERR_MEMORY;
      goto done;
    }
  }
done:
  return status;
}

/* The most unknowns of the reduction that an element depends on, padded. */
static fs_status count_reduced(const fs_problem *p, const fs_reduction *r, size_t *most) {
  fs_status status = FS_OK;
  int32_t *mark = NULL;
  *most = 0;
  FS_ALLOC(p->ctx, mark, r->n_columns);
  for (int32_t i = 0; i < p->space->n_elements; i++) {
    const fs_element *e = &p->space->element[i];
    size_t n = 0;
    for (int32_t d = 0; d < p->space->extraction[e->extraction].n_dofs; d++) {
      int32_t unknown = p->unknown[p->space->dof[e->dof_start + d]];
      if (unknown == FS_NONE) continue;
      for (int32_t k = r->row_start[unknown]; k < r->row_start[unknown + 1]; k++) {
        n += mark[r->column[k]] != i + 1;
        mark[r->column[k]] = i + 1;
      }
    }
    if (n > *most) *most = n;
  }
  *most = (*most + 7) / 8 * 8;
done:
  fs_release(p->ctx, mark);
  return status;
}

static void free_reduced(fs_problem *p) {
  for (int32_t i = 0; p->result != NULL && i < p->n_batch; i++) {
    fs_release(p->ctx, p->result[i].reduced);
    p->result[i].reduced = NULL;
  }
  for (int32_t i = 0; p->work != NULL && i < fs_n_workers(p->ctx); i++) {
    fs_release(p->ctx, p->work[i]);
    p->work[i] = NULL;
  }
  fs_release(p->ctx, p->square_axis);
  p->square_axis = NULL;
}

fs_status fs_problem_reduce(fs_problem *p, const fs_reduction *reduction) {
  fs_status status = FS_OK;
  size_t n;
  p->reduction = NULL;
  free_reduced(p);
  if (reduction == NULL) return FS_OK;
  FS_TRY(count_reduced(p, reduction, &n));
  for (int32_t i = 0; i < p->n_batch; i++) {
    FS_ALLOC(p->ctx, p->result[i].reduced, 6 * n * n);
    if (n <= p->n_listed) continue;
    fs_release(p->ctx, p->result[i].list);
    fs_release(p->ctx, p->result[i].place);
    p->result[i].list = p->result[i].place = NULL;
    FS_ALLOC(p->ctx, p->result[i].list, n);
    FS_ALLOC(p->ctx, p->result[i].place, n);
  }
  if (n > p->n_listed) p->n_listed = n;
  for (int32_t i = 0; i < fs_n_workers(p->ctx); i++) FS_ALLOC(p->ctx, p->work[i], 2 * p->n_largest * n);
  if (reduction->squares != NULL)
    FS_ALLOC(p->ctx, p->square_axis, (size_t)reduction->squares->n_side * FS_TENSOR_KEPT_ROWS * 16);
  p->reduction = reduction;
done:
  return status;
}

/* Far from the end fewer nodes do; extra dofs of caps would exploit a rule that is too coarse. */
static int32_t nodes_of(const fs_problem *p, const fs_extraction *x, int32_t level) {
  int32_t n = x->valence == 4 ? p->n_nodes_square : p->n_nodes_cap;
  static const int32_t most_square[FS_N_NODES] = {INT32_MAX, 4, 2, 6},
                       most_cap[FS_N_NODES] = {INT32_MAX, 10, 10, INT32_MAX};
  int32_t most = x->valence == 4 ? most_square[level] : most_cap[level];
  return n < most ? n : most;
}

fs_status fs_problem_set_level(fs_problem *p, int32_t level) {
  fs_status status = FS_OK;
  if (p->tables[level] == NULL) {
    FS_ALLOC(p->ctx, p->tables[level], p->space->n_extractions);
    for (int32_t i = 0; i < p->space->n_extractions; i++)
      FS_TRY(fs_basis_create(p->ctx, &p->space->extraction[i], nodes_of(p, &p->space->extraction[i], level),
                             &p->tables[level][i]));
  }
  p->table = p->tables[level];
  p->level = level;
done:
  return status;
}

fs_status fs_problem_create(fs_context *ctx, const fs_space *space, int32_t n_terms, const fs_density *const *term,
                            const bool *fixed, int32_t n_nodes_square, int32_t n_nodes_cap, const fs_vec3 *c,
                            fs_problem **result) {
  fs_status status = FS_OK;
  fs_problem *p = NULL;
  FS_ALLOC(ctx, p, 1);
  p->ctx = ctx;
  p->space = space;
  p->n_terms = n_terms;
  p->kernels = fs_kernels_choose();
  for (int32_t t = 0; t < n_terms; t++) {
    p->term[t] = term[t];
    p->sum[t] = fs_kernels_sum_of(p->kernels, term[t]);
    if (term[t]->order < 1 || term[t]->order > 3 || term[t]->order > space->continuity + 1) {
      status =
          fs_fail(ctx, FS_ERR_UNSUPPORTED, "the density %s of order %d needs contact of order %d, the space has %d",
                  term[t]->name, term[t]->order, term[t]->order - 1, space->continuity);
      goto done;
    }
  }
  FS_ALLOC(ctx, p->c, space->n_dofs);
  memcpy(p->c, c, (size_t)space->n_dofs * sizeof *c);
  p->n_nodes_square = n_nodes_square;
  p->n_nodes_cap = n_nodes_cap;
  FS_TRY(fs_problem_set_level(p, 0));
  FS_TRY(number_unknowns(ctx, p, fixed));
  FS_TRY(make_pattern(ctx, p));
  FS_TRY(make_buffers(ctx, p));
  *result = p;
  p = NULL;
done:
  fs_problem_free(ctx, p);
  return status;
}

void fs_problem_free(fs_context *ctx, fs_problem *p) {
  if (p == NULL) return;
  for (int level = 0; level < FS_N_NODES; level++) {
    for (int32_t i = 0; p->tables[level] != NULL && i < p->space->n_extractions; i++)
      fs_basis_free(ctx, p->tables[level][i]);
    fs_release(ctx, p->tables[level]);
  }
  free_reduced(p);
  for (int32_t i = 0; p->result != NULL && i < p->n_batch; i++) {
    fs_release(ctx, p->result[i].gradient);
    fs_release(ctx, p->result[i].hessian);
    fs_release(ctx, p->result[i].list);
    fs_release(ctx, p->result[i].place);
  }
  for (int32_t i = 0; p->scratch != NULL && i < fs_n_workers(ctx); i++) fs_release(ctx, p->scratch[i]);
  fs_release(ctx, p->result);
  fs_release(ctx, p->scratch);
  fs_release(ctx, p->work);
  fs_release(ctx, p->unknown);
  fs_release(ctx, p->c);
  fs_sparse_free(ctx, p->pattern);
  fs_release(ctx, p);
}

void fs_problem_set(fs_problem *p, const double *x) {
  for (int32_t d = 0; d < p->space->n_dofs; d++)
    if (p->unknown[d] != FS_NONE) memcpy(&p->c[d], x + 3 * (size_t)p->unknown[d], sizeof p->c[d]);
}

void fs_problem_get(const fs_problem *p, double *x) {
  for (int32_t d = 0; d < p->space->n_dofs; d++)
    if (p->unknown[d] != FS_NONE) memcpy(x + 3 * (size_t)p->unknown[d], &p->c[d], sizeof p->c[d]);
}
