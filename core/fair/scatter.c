/* SPDX-License-Identifier: MIT */
/* Single role: Hessians of elements become one sparse matrix.

   Every block of columns belongs to one range of the parallel loop, which passes over all elements of the batch in their
   order: no lock, and the same sums in the same order for any number of threads. Within an element the unknowns are sorted, so
   that places in a column are found by walking down it once. */
#include "fair/scatter.h"

#include <string.h>

enum { N_SHARES = 64, COLUMNS_PER_SHARE = 16 };

/* By insertion: short, and nearly sorted as a rule. */
static void sort_list(fs_element_result *result) {
  for (int32_t i = 1; i < result->n_list; i++) {
    int32_t unknown = result->list[i], place = result->place[i], j = i;
    for (; j > 0 && result->list[j - 1] > unknown; j--) {
      result->list[j] = result->list[j - 1];
      result->place[j] = result->place[j - 1];
    }
    result->list[j] = unknown;
    result->place[j] = place;
  }
}

void fs_element_list(const fs_problem *p, const fs_element *e, int32_t n_dofs, fs_element_result *result) {
  const fs_reduction *r = p->reduction;
  result->n_list = 0;
  for (int32_t d = 0; d < n_dofs; d++) {
    int32_t unknown = p->unknown[p->space->dof[e->dof_start + d]];
    if (unknown == FS_NONE) continue;
    if (r == NULL) {
      result->list[result->n_list] = unknown;
      result->place[result->n_list++] = d;
      continue;
    }
    for (int32_t k = r->row_start[unknown]; k < r->row_start[unknown + 1]; k++) {
      int32_t i = 0;
      while (i < result->n_list && result->list[i] != r->column[k]) i++;
      if (i < result->n_list) continue;
      result->list[i] = r->column[k];
      result->place[i] = i;
      result->n_list++;
    }
  }
  sort_list(result);
}

void fs_square_list(const int32_t unknown[16], fs_element_result *result) {
  result->n_list = 0;
  for (int32_t k = 0; k < 16; k++) {
    if (unknown[k] == FS_NONE) continue;
    result->list[result->n_list] = unknown[k];
    result->place[result->n_list++] = k;
  }
  sort_list(result);
}

/* T[n_dofs][n_padded] of the element, columns in the places of the list. */
static void local_map(const fs_problem *p, const fs_element *e, int32_t n_dofs, const fs_element_result *result,
                      int32_t n_padded, double *T) {
  const fs_reduction *r = p->reduction;
  memset(T, 0, (size_t)n_dofs * (size_t)n_padded * sizeof *T);
  for (int32_t d = 0; d < n_dofs; d++) {
    int32_t unknown = p->unknown[p->space->dof[e->dof_start + d]];
    if (unknown == FS_NONE) continue;
    for (int32_t k = r->row_start[unknown]; k < r->row_start[unknown + 1]; k++) {
      int32_t low = 0, high = result->n_list;
      while (high - low > 1) {
        int32_t middle = low + (high - low) / 2;
        if (result->list[middle] <= r->column[k])
          low = middle;
        else
          high = middle;
      }
      T[(size_t)d * (size_t)n_padded + (size_t)low] += r->weight[k];
    }
  }
}

void fs_element_reduce(const fs_problem *p, const fs_element *e, int32_t n_dofs, int32_t m_padded, double *work,
                       fs_element_result *result) {
  int32_t n_padded = (result->n_list + 7) / 8 * 8;
  for (int32_t i = 0; i < result->n_list; i++) result->place[i] = i;
  local_map(p, e, n_dofs, result, n_padded, work);
  p->kernels->congruence(n_dofs, m_padded, n_padded, work, result->hessian, work + (size_t)n_dofs * (size_t)n_padded,
                         result->reduced);
  result->matrix = result->reduced;
  result->n_matrix = n_padded;
}

typedef struct batch {
  const fs_element_result *result;
  int32_t n;
  fs_sparse *hessian;
} batch;

/* The matrix of one element to the columns of the shares begin .. end - 1. */
static void add_element(const fs_element_result *result, int32_t begin, int32_t end, fs_sparse *hessian) {
  static const int pair[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  const double *h = result->matrix;
  size_t m = (size_t)result->n_matrix;
  for (int32_t s = 0; s < result->n_list; s++) {
    int32_t j = result->list[s], share = j / COLUMNS_PER_SHARE % N_SHARES, first = s, n;
    const int32_t *row;
    double *column;
    if (share < begin || share >= end) continue;
    n = hessian->col_start[j + 1] - hessian->col_start[j];
    row = hessian->row + hessian->col_start[j];
    column = hessian->value + 9 * (size_t)hessian->col_start[j];
    while (first > 0 && result->list[first - 1] == j) first--; /* a dof that occurs twice is coupled both ways */
    for (int32_t t = first; t < result->n_list; t++) {
      size_t a = (size_t)result->place[t], b = (size_t)result->place[s];
      while (*row < result->list[t]) {
        row++;
        column += 3;
      }
      for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) { /* component r of dof a, component c of dof b; equal ones: the upper part only */
          bool is_swapped = r > c || (r == c && a > b);
          column[(size_t)(3 * n * c + r)] +=
              h[((size_t)pair[r][c] * m + (is_swapped ? b : a)) * m + (is_swapped ? a : b)];
        }
    }
  }
}

static fs_status add_batch(void *user, int32_t begin, int32_t end, int32_t worker) {
  const batch *b = user;
  (void)worker;
  for (int32_t i = 0; i < b->n; i++)
    if (b->result[i].order >= FS_HESSIAN) add_element(&b->result[i], begin, end, b->hessian);
  return FS_OK;
}

fs_status fs_scatter_hessians(const fs_problem *p, int32_t n, fs_sparse *hessian) {
  batch b = {p->result, n, hessian};
  return fs_parallel_for(p->ctx, N_SHARES, add_batch, &b);
}
