/* SPDX-License-Identifier: MIT */
/* Single role: V = 1/3 sum over elements of the integral of det(p, p_u, p_v), a polynomial of degree 3 n - 1 in u, which
   3 n / 2 Gauss nodes integrate exactly. With p = sum N_k c_k and <.> for the integral over the element:

     dV/dc_k        = 1/3 <N_k p_u x p_v + N_k,u p_v x p + N_k,v p x p_u>
     d2V/dc_k dc_l  = (e_a, e_b) -> det(e_a, e_b, X),
     X              = 1/3 <(N_k N_l,u - N_l N_k,u) p_v - (N_k N_l,v - N_l N_k,v) p_u + (N_k,u N_l,v - N_l,u N_k,v) p> */
#include "fair/volume.h"
#include "fair/constrain.h"
#include "math/quadrature.h"
#include "math/vec3.h"

#include <string.h>

enum { MAX_NODES = 64, BATCH_NUMBERS = 1 << 20, MAX_BATCH = 256 };

/* Functions of an extraction and their first derivatives at nodes. */
typedef struct table {
  int32_t n, n_dofs;
  double *weight; /* [n] */
  double *basis;  /* [n][3][n_dofs]: N, N_u, N_v */
} table;

struct fs_volume {
  fs_problem *problem;
  table *tables; /* [n_extractions] */
  int32_t n_batch, n_numbers;
  double *value;  /* [n_batch] */
  double *number; /* [n_batch][n_numbers]: gradient [n_dofs][3], then X [n_dofs][n_dofs][3] */
};

static fs_status table_create(fs_context *ctx, const fs_extraction *x, table *t) {
  fs_status status = FS_OK;
  int32_t degree = x->degree_u > x->degree_v ? x->degree_u : x->degree_v, n = 3 * degree / 2 + 1;
  double node[MAX_NODES], weight[MAX_NODES];
  if (n > MAX_NODES)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "the volume is kept for elements up to degree %d, and one has degree %d",
                   2 * (MAX_NODES - 1) / 3, degree);
  FS_TRY(fs_gauss_legendre(ctx, n, node, weight));
  t->n = n * n;
  t->n_dofs = x->n_dofs;
  FS_ALLOC(ctx, t->weight, t->n);
  FS_ALLOC(ctx, t->basis, 3 * (size_t)t->n * (size_t)x->n_dofs);
  for (int32_t q = 0; q < t->n; q++) {
    double *basis = t->basis + 3 * (size_t)q * (size_t)x->n_dofs;
    t->weight[q] = weight[q % n] * weight[q / n] / 3;
    fs_constrain_weights(x, node[q % n], node[q / n], 0, 0, basis);
    fs_constrain_weights(x, node[q % n], node[q / n], 1, 0, basis + x->n_dofs);
    fs_constrain_weights(x, node[q % n], node[q / n], 0, 1, basis + 2 * x->n_dofs);
  }
done:
  return status;
}

fs_status fs_volume_create(fs_problem *p, fs_volume **volume) {
  fs_status status = FS_OK;
  fs_context *ctx = p->ctx;
  fs_volume *v = NULL;
  int32_t largest = 0;
  FS_ALLOC(ctx, v, 1);
  v->problem = p;
  FS_ALLOC(ctx, v->tables, p->space->n_extractions);
  for (int32_t i = 0; i < p->space->n_extractions; i++) {
    FS_TRY(table_create(ctx, &p->space->extraction[i], &v->tables[i]));
    if (v->tables[i].n_dofs > largest) largest = v->tables[i].n_dofs;
  }
  v->n_numbers = 3 * largest * (largest + 1);
  v->n_batch = BATCH_NUMBERS / v->n_numbers;
  if (v->n_batch < 1) v->n_batch = 1;
  if (v->n_batch > MAX_BATCH) v->n_batch = MAX_BATCH;
  FS_ALLOC(ctx, v->value, v->n_batch);
  FS_ALLOC(ctx, v->number, (size_t)v->n_batch * (size_t)v->n_numbers);
  *volume = v;
  v = NULL;
done:
  fs_volume_free(v);
  return status;
}

void fs_volume_free(fs_volume *v) {
  fs_context *ctx;
  if (v == NULL) return;
  ctx = v->problem->ctx;
  for (int32_t i = 0; v->tables != NULL && i < v->problem->space->n_extractions; i++) {
    fs_release(ctx, v->tables[i].weight);
    fs_release(ctx, v->tables[i].basis);
  }
  fs_release(ctx, v->tables);
  fs_release(ctx, v->value);
  fs_release(ctx, v->number);
  fs_release(ctx, v);
}

/* ---- one element ------------------------------------------------------------------------------------------------- */

static void add_to(double *to, fs_vec3 p, double s) { to[0] += s * p.x, to[1] += s * p.y, to[2] += s * p.z; }

static void add_gradient(int32_t m, const double *N, double weight, const fs_vec3 x[3], double *g) {
  fs_vec3 by_value = fs_vec3_cross(x[1], x[2]), by_u = fs_vec3_cross(x[2], x[0]), by_v = fs_vec3_cross(x[0], x[1]);
  for (int32_t k = 0; k < m; k++) {
    add_to(g + 3 * k, by_value, weight * N[k]);
    add_to(g + 3 * k, by_u, weight * N[m + k]);
    add_to(g + 3 * k, by_v, weight * N[2 * m + k]);
  }
}

static void add_X(int32_t m, const double *N, double weight, const fs_vec3 x[3], double *X) {
  const double *U = N + m, *V = N + 2 * m;
  for (int32_t k = 0; k < m; k++)
    for (int32_t l = k + 1; l < m; l++) {
      double *to = X + 3 * ((size_t)k * (size_t)m + (size_t)l);
      add_to(to, x[2], weight * (N[k] * U[l] - N[l] * U[k]));
      add_to(to, x[1], -weight * (N[k] * V[l] - N[l] * V[k]));
      add_to(to, x[0], weight * (U[k] * V[l] - U[l] * V[k]));
    }
}

typedef struct batch {
  fs_volume *volume;
  fs_order order;
  int32_t first;
} batch;

static fs_status run_batch(void *user, int32_t begin, int32_t end, int32_t worker) {
  const batch *b = user;
  fs_volume *v = b->volume;
  const fs_problem *p = v->problem;
  (void)worker;
  for (int32_t i = begin; i < end; i++) {
    const fs_element *e = &p->space->element[b->first + i];
    const int32_t *dof = p->space->dof + e->dof_start;
    const table *t = &v->tables[e->extraction];
    int32_t m = t->n_dofs;
    double *g = v->number + (size_t)i * (size_t)v->n_numbers, *X = g + 3 * m;
    v->value[i] = 0;
    if (b->order >= FS_GRADIENT) memset(g, 0, 3 * (size_t)m * sizeof *g);
    if (b->order >= FS_HESSIAN) memset(X, 0, 3 * (size_t)m * (size_t)m * sizeof *X);
    for (int32_t q = 0; q < t->n; q++) {
      const double *N = t->basis + 3 * (size_t)q * (size_t)m;
      fs_vec3 x[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
      for (int a = 0; a < 3; a++)
        for (int32_t k = 0; k < m; k++) x[a] = fs_vec3_add_scaled(x[a], p->c[dof[k]], N[a * m + k]);
      v->value[i] += t->weight[q] * fs_vec3_dot(x[0], fs_vec3_cross(x[1], x[2]));
      if (b->order >= FS_GRADIENT) add_gradient(m, N, t->weight[q], x, g);
      if (b->order >= FS_HESSIAN) add_X(m, N, t->weight[q], x, X);
    }
  }
  return FS_OK;
}

/* ---- all elements ------------------------------------------------------------------------------------------------ */

static void scatter(const fs_problem *p, const int32_t *dof, int32_t m, double factor, const double *X,
                    fs_sparse *hessian) {
  for (int32_t k = 0; k < m; k++)
    for (int32_t l = k + 1; l < m; l++) {
      int32_t i = p->unknown[dof[k]], j = p->unknown[dof[l]];
      const double *x = X + 3 * ((size_t)k * (size_t)m + (size_t)l);
      double s = i > j ? factor : -factor; /* the transposed block is that of -X */
      const double block[9] = {0, s * x[2], -s * x[1], -s * x[2], 0, s * x[0], s * x[1], -s * x[0], 0};
      if (i == FS_NONE || j == FS_NONE || i == j) continue; /* X and -X of one dof cancel */
      fs_sparse_add(hessian, i > j ? i : j, i > j ? j : i, block);
    }
}

fs_status fs_volume_evaluate(fs_volume *v, fs_order order, double factor, double *value, double *g,
                             fs_sparse *hessian) {
  fs_status status = FS_OK;
  const fs_problem *p = v->problem;
  double sum = 0;
  for (int32_t first = 0; first < p->space->n_elements; first += v->n_batch) {
    batch b = {v, order, first};
    int32_t n = p->space->n_elements - first < v->n_batch ? p->space->n_elements - first : v->n_batch;
    FS_TRY(fs_parallel_for(p->ctx, n, run_batch, &b));
    for (int32_t i = 0; i < n; i++) {
      const fs_element *e = &p->space->element[first + i];
      const int32_t *dof = p->space->dof + e->dof_start;
      const double *number = v->number + (size_t)i * (size_t)v->n_numbers;
      int32_t m = v->tables[e->extraction].n_dofs;
      sum += v->value[i];
      for (int32_t k = 0; k < m && order >= FS_GRADIENT; k++)
        for (int a = 0; a < 3 && p->unknown[dof[k]] != FS_NONE; a++)
          g[3 * (size_t)p->unknown[dof[k]] + (size_t)a] += factor * number[3 * k + a];
      if (order >= FS_HESSIAN) scatter(p, dof, m, factor, number + 3 * m, hessian);
    }
  }
  if (value != NULL) *value = sum;
done:
  return status;
}
