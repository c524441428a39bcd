/* SPDX-License-Identifier: MIT */
/* Single role: from densities at points to integrals, gradients and Hessians over all elements.

     F(c) = sum over elements e, points q, terms t of  w_t w_q f_t(N_q c_e)
   N_q: the nine basis derivatives at the point. With the gradient f' and Hessian f'' of the density by the derivatives:
     dF/dc_e   = sum w_t w_q N_q^T f'           d2F/dc_e2 = sum w_t w_q N_q^T f'' N_q.
   All terms are added at the point, before the chain rule to the dofs; those fed derivatives by the coordinates of a chart are
   turned into derivatives by (u, v) first. Elements are computed in parallel,
   a batch at a time, and added in their order, so that results do not depend on the number of threads.

   Under displacements of a coarser mesh the Hessian by the unknowns of a coarse square is the sum over all points of all elements
   within, with basis functions of the square: c_e = T_e y, and N_q T_e is again a product of functions of u and of v. */
#include "fair/coarse_squares.h"
#include "fair/scatter.h"

#include <math.h>
#include <string.h>

enum { N = FS_N_DERIVATIVES, B = FS_BLOCK, N_PAIRS = N * (N + 1) / 2, MAX_DOFS = 240 };

/* What one worker needs for one block of points. */
typedef struct scratch {
  double x[N * 3 * B], f[B], df[N * 3 * B], ddf[N_PAIRS * 9 * B]; /* of one density */
  double sum_df[N * 3 * B], sum_ddf[N_PAIRS * 9 * B];             /* of all terms, by (u, v) */
  double z[N * 3 * B];                                            /* derivatives by the coordinates of the chart */
  double c[MAX_DOFS * 3];
  fs_tensor tensor;
  bool is_without_gradient;
} scratch;

size_t fs_assemble_scratch_size(void) { return sizeof(scratch); }

static int32_t pair_number(int32_t i, int32_t j, int32_t n) { return i * n - i * (i - 1) / 2 + j - i; }

/* Moves the derivatives of a density of lower order to their places among the nine vectors. */
static void widen(int32_t order_of_density, fs_order order, scratch *s) {
  static const int32_t n_of_order[4] = {0, 2, 5, 9};
  int32_t n = n_of_order[order_of_density];
  if (n == N) return;
  memset(s->df + 3 * n * B, 0, (size_t)(3 * (N - n) * B) * sizeof(double));
  if (order < FS_HESSIAN) return;
  for (int32_t i = N - 1; i >= 0; i--) /* from the end: pairs only move up */
    for (int32_t j = N - 1; j >= i; j--) {
      double *to = s->ddf + (size_t)pair_number(i, j, N) * 9 * B;
      if (j < n)
        memmove(to, s->ddf + (size_t)pair_number(i, j, n) * 9 * B, 9 * B * sizeof *to);
      else
        memset(to, 0, 9 * B * sizeof *to);
    }
}

/* sum (+)= scale[B] times the derivatives of one density; the first one is not added but stored. */
static void add_density(const fs_kernels *kernels, const fs_density *density, fs_order order, const double *scale,
                        bool is_first, scratch *s) {
  uint64_t zero = density->order == 3 && !is_first ? density->zero_pairs : 0;
  kernels->add_scaled(3 * N, scale, s->df, is_first, s->sum_df);
  if (order < FS_HESSIAN) return;
  for (int pair = 0; pair < N_PAIRS; pair++)
    if (!(zero >> pair & 1))
      kernels->add_scaled(9, scale, s->ddf + (size_t)pair * 9 * B, is_first, s->sum_ddf + (size_t)pair * 9 * B);
}

/* All terms at one block of points. */
static void add_block(const fs_problem *p, const fs_basis_table *table, int32_t block, fs_order order, scratch *s,
                      fs_element_result *result) {
  const double *by_dof = table->by_dof + (size_t)block * N * table->n_dofs * B;
  bool is_first = true;
  int n = table->n_nodes * table->n_nodes - block * B; /* points; those beyond repeat the last one without weight */
  if (n > B) n = B;
  p->kernels->jets(table->n_dofs, by_dof, s->c, s->x);
  for (int32_t t = 0; t < p->n_terms; t++) {
    const fs_density *density = p->term[t];
    bool on_chart = table->inverse != NULL && !density->is_geometric;
    const double *weight = (on_chart ? table->chart_weight : table->weight) + block * B;
    const double *inverse = on_chart ? table->inverse + (size_t)block * N * N * B : NULL;
    fs_order wanted = p->weight[t] != 0 ? order : FS_VALUE; /* a term without weight is only measured */
    bool is_added = p->sum[t] != NULL && !on_chart;
    double scale[B];
    for (int l = 0; l < B; l++) scale[l] = p->weight[t] * weight[l];
    if (on_chart) p->kernels->to_chart(inverse, s->x, s->z);
    if (is_added)
      p->sum[t](s->x, scale, n, is_first, s->f, wanted >= FS_GRADIENT ? s->sum_df : NULL,
                wanted >= FS_HESSIAN ? s->sum_ddf : NULL);
    else
      density->evaluate(on_chart ? s->z : s->x, s->f, wanted >= FS_GRADIENT ? s->df : NULL,
                        wanted >= FS_HESSIAN ? s->ddf : NULL);
    for (int l = 0; l < n; l++) result->integral[t] += weight[l] * s->f[l];
    if (wanted == FS_VALUE) continue;
    if (!is_added) widen(density->order, wanted, s);
    if (on_chart) {
      if (is_first) memset(s->sum_df, 0, sizeof s->sum_df);
      if (is_first && wanted >= FS_HESSIAN) memset(s->sum_ddf, 0, sizeof s->sum_ddf);
      p->kernels->add_from_chart(inverse, scale, s->df, wanted >= FS_HESSIAN ? s->ddf : NULL, s->sum_df, s->sum_ddf);
    } else if (!is_added) {
      add_density(p->kernels, density, wanted, scale, is_first, s);
    }
    is_first = false;
  }
  if (order == FS_VALUE || is_first) return;
  if (!s->is_without_gradient) p->kernels->gradient(table->n_dofs, by_dof, s->sum_df, result->gradient);
  if (order < FS_HESSIAN) return;
  if (table->axis != NULL)
    p->kernels->hessian_tensor(&s->tensor, block, s->sum_ddf);
  else
    p->kernels->hessian(table->n_padded, table->by_point + (size_t)block * B * N * table->n_padded, s->sum_ddf,
                        result->hessian);
}

static void add_element(const fs_problem *p, const fs_basis_table *table, fs_order order, scratch *s,
                        fs_element_result *result) {
  s->tensor.n_nodes = table->n_nodes;
  s->tensor.axis_u = s->tensor.axis_v = table->axis;
  s->tensor.is_first_u = s->tensor.is_last_u = s->tensor.is_first_v = true;
  s->tensor.keeps_rows = false;
  for (int32_t block = 0; block < table->n_blocks; block++) add_block(p, table, block, order, s, result);
  if (order >= FS_HESSIAN && table->axis != NULL) p->kernels->hessian_tensor_finish(&s->tensor, result->hessian);
}

/* Squares of a coarser mesh, then elements; without squares these are all. */
typedef struct batch {
  fs_problem *problem;
  fs_order order;
  const fs_coarse_squares *squares;
  int32_t first;
  bool is_without_gradient;
} batch;

/* The element that an item is, or FS_NONE: a square. */
static int32_t element_of(const batch *b, int32_t item) {
  if (b->squares == NULL) return item;
  return item < b->squares->n ? FS_NONE : b->squares->loose[item - b->squares->n];
}

static bool has_free_dof(const fs_problem *p, const fs_element *e, int32_t n_dofs) {
  for (int32_t d = 0; d < n_dofs; d++)
    if (p->unknown[p->space->dof[e->dof_start + d]] != FS_NONE) return true;
  return false;
}

/* The dofs of an element in places 0 … n - 1, or in those of a square that it is turned to. */
static void gather_dofs(const fs_problem *p, const fs_element *e, int32_t n_dofs, int32_t turn, scratch *s) {
  for (int32_t d = 0; d < n_dofs; d++) {
    fs_vec3 c = p->c[p->space->dof[e->dof_start + (turn == 0 ? d : fs_turned_place(d, turn))]];
    s->c[3 * d] = c.x;
    s->c[3 * d + 1] = c.y;
    s->c[3 * d + 2] = c.z;
  }
}

static void run_element(const batch *b, const fs_element *e, int32_t worker, fs_element_result *result) {
  fs_problem *p = b->problem;
  scratch *s = p->scratch[worker];
  const fs_basis_table *table = p->table[e->extraction];
  result->order = b->order > FS_VALUE && has_free_dof(p, e, table->n_dofs) ? b->order : FS_VALUE;
  gather_dofs(p, e, table->n_dofs, 0, s);
  if (result->order >= FS_GRADIENT) memset(result->gradient, 0, 3 * (size_t)table->n_dofs * sizeof(double));
  if (result->order >= FS_HESSIAN && table->axis == NULL)
    memset(result->hessian, 0, 6 * (size_t)table->n_padded * (size_t)table->n_padded * sizeof(double));
  add_element(p, table, result->order, s, result);
  if (result->order < FS_HESSIAN) return;
  fs_element_list(p, e, table->n_dofs, result);
  result->matrix = result->hessian;
  result->n_matrix = table->n_padded;
  if (p->reduction != NULL) fs_element_reduce(p, e, table->n_dofs, table->n_padded, p->work[worker], result);
}

static void run_square(const batch *b, int32_t number, int32_t worker, fs_element_result *result) {
  const fs_problem *p = b->problem;
  const fs_coarse_squares *q = b->squares;
  scratch *s = p->scratch[worker];
  fs_tensor *t = &s->tensor;
  int32_t n_side = q->n_side, at = number * n_side * n_side;
  result->order = FS_HESSIAN;
  for (int32_t k = 0; k < n_side * n_side; k++) {
    const fs_element *e = &p->space->element[q->element[at + k]];
    const fs_basis_table *table = p->table[e->extraction];
    t->n_nodes = table->n_nodes;
    t->axis_u = p->square_axis + (size_t)(k % n_side) * FS_TENSOR_KEPT_ROWS * 16;
    t->axis_v = p->square_axis + (size_t)(k / n_side) * FS_TENSOR_KEPT_ROWS * 16;
    t->is_first_u = k % n_side == 0;
    t->is_last_u = k % n_side == n_side - 1;
    t->is_first_v = k < n_side;
    t->keeps_rows = true;
    gather_dofs(p, e, table->n_dofs, q->turn[at + k], s);
    for (int32_t block = 0; block < table->n_blocks; block++) add_block(p, table, block, FS_HESSIAN, s, result);
  }
  p->kernels->hessian_tensor_finish(t, result->hessian);
  fs_square_list(q->unknown[number], result);
  result->matrix = result->hessian;
  result->n_matrix = FS_TENSOR_SIDE;
}

static fs_status run_batch(void *user, int32_t begin, int32_t end, int32_t worker) {
  const batch *b = user;
  for (int32_t i = begin; i < end; i++) {
    fs_element_result *result = &b->problem->result[i];
    int32_t element = element_of(b, b->first + i);
    memset(result->integral, 0, sizeof result->integral);
    ((scratch *)b->problem->scratch[worker])->is_without_gradient = b->is_without_gradient;
    if (element == FS_NONE)
      run_square(b, b->first + i, worker, result);
    else
      run_element(b, &b->problem->space->element[element], worker, result);
  }
  return FS_OK;
}

/* The squares of the reduction, if there are any, with the functions of their unknowns at the nodes. */
static const fs_coarse_squares *begin_squares(fs_problem *p) {
  const fs_coarse_squares *q = p->reduction != NULL ? p->reduction->squares : NULL;
  const fs_basis_table *table;
  if (q == NULL || q->n == 0) return NULL;
  table = p->table[p->space->element[q->element[0]].extraction];
  if (table->n_nodes > FS_TENSOR_KEPT_ROWS) return NULL;
  for (int32_t a = 0; a < q->n_side; a++)
    for (int32_t i = 0; i < 4 * table->n_nodes; i++) /* nodes and orders */
      for (int32_t k = 0; k < 4; k++) {
        double *to = p->square_axis + (size_t)a * FS_TENSOR_KEPT_ROWS * 16 + (size_t)(4 * i + k);
        *to = 0;
        for (int32_t j = 0; j < 4; j++) *to += table->axis[4 * i + j] * q->mask[a + j][k];
      }
  return q;
}

fs_status fs_problem_evaluate(fs_problem *p, fs_order order, double *integral, double *integral_caps, double *g,
                              fs_sparse *hessian) {
  fs_status status = FS_OK;
  const fs_space *space = p->space;
  double all[FS_MAX_TERMS + 2] = {0}, caps[FS_MAX_TERMS + 2] = {0};
  batch b = {.problem = p, .order = order, .is_without_gradient = g == NULL};
  int32_t n_items;
  if (order >= FS_HESSIAN && g == NULL) b.squares = begin_squares(p);
  n_items = b.squares != NULL ? b.squares->n + b.squares->n_loose : space->n_elements;
  if (g != NULL) memset(g, 0, 3 * (size_t)p->n_free * sizeof *g);
  if (order >= FS_HESSIAN) fs_sparse_clear(hessian);
  for (; b.first < n_items; b.first += p->n_batch) {
    int32_t n = n_items - b.first < p->n_batch ? n_items - b.first : p->n_batch;
    FS_TRY(fs_parallel_for(p->ctx, n, run_batch, &b));
    for (int32_t i = 0; i < n; i++) {
      int32_t number = element_of(&b, b.first + i);
      const fs_element *e = number != FS_NONE ? &space->element[number] : NULL;
      const fs_element_result *result = &p->result[i];
      for (int32_t t = 0; t < p->n_terms; t++) {
        all[t] += result->integral[t];
        if (e != NULL && space->extraction[e->extraction].valence != 4) caps[t] += result->integral[t];
      }
      if (result->order == FS_VALUE || g == NULL) continue;
      for (int32_t d = 0; d < p->table[e->extraction]->n_dofs; d++) {
        int32_t unknown = p->unknown[space->dof[e->dof_start + d]];
        if (unknown == FS_NONE) continue;
        for (int k = 0; k < 3; k++) g[3 * (size_t)unknown + k] += result->gradient[3 * d + k];
      }
    }
    if (order >= FS_HESSIAN) FS_TRY(fs_scatter_hessians(p, n, hessian));
  }
  if (integral != NULL) memcpy(integral, all, sizeof *all * (size_t)p->n_terms);
  if (integral_caps != NULL) memcpy(integral_caps, caps, sizeof *caps * (size_t)p->n_terms);
done:
  return status;
}

fs_status fs_problem_find_singular(fs_problem *p, int32_t *face) {
  fs_status status = FS_OK;
  *face = FS_NONE;
  for (int32_t first = 0; first < p->space->n_elements && *face == FS_NONE; first += p->n_batch) {
    batch b = {.problem = p, .order = FS_VALUE, .first = first};
    int32_t n = p->space->n_elements - first < p->n_batch ? p->space->n_elements - first : p->n_batch;
    FS_TRY(fs_parallel_for(p->ctx, n, run_batch, &b));
    for (int32_t i = n - 1; i >= 0; i--)
      for (int32_t t = 0; t < p->n_terms; t++)
        if (!isfinite(p->result[i].integral[t])) *face = p->space->element[first + i].face;
  }
done:
  return status;
}
