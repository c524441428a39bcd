/* SPDX-License-Identifier: MIT */
/* Single role: a wall at the distance D from a target, by the method of multipliers [Hestenes 1969; Powell 1969; Nocedal
   Wright 2006, section 17.3]. What is added to the functional is

     W = sum over samples of (max(0, force + stiffness (d - D))^2 - force^2) / (2 stiffness),

   d the distance of a sample from the target, whose gradient by the sample is n = (p - nearest) / d. At its minimum the force
   that acts on a sample is max(0, force + stiffness (d - D)); taken as the next force it holds the sample nearer to the wall,
   and in the limit at the wall. Of the Hessian stiffness n n^T is kept, and the force times the Hessian of d by differences
   of n. A distance is asked for only where the last one leaves it possible that a force acts: distances change by no more than
   the point moves.

   Walls that grow beyond all bounds (barriers) were tried: steps end so near to them that the next ones are minute. */
#include "fair/wall.h"
#include "fair/constrain.h"
#include "math/vec3.h"

#include <string.h>

enum { GRID_SQUARE = 5, GRID_CAP = 9, BATCH_NUMBERS = 1 << 20, MAX_BATCH = 256 };

static fs_status grid_create(fs_context *ctx, const fs_extraction *x, fs_grid_table *t) {
  fs_status status = FS_OK;
  t->n = x->valence == 4 ? GRID_SQUARE : GRID_CAP;
  FS_ALLOC(ctx, t->basis, (size_t)t->n * (size_t)t->n * (size_t)x->n_dofs);
  for (int32_t i = 0; i < t->n * t->n; i++)
    fs_constrain_weights(x, (double)(i % t->n) / (t->n - 1), (double)(i / t->n) / (t->n - 1), 0, 0,
                         t->basis + (size_t)i * (size_t)x->n_dofs);
done:
  return status;
}

fs_status fs_wall_create(fs_problem *p, const fs_target *target, double limit, fs_wall **wall) {
  fs_status status = FS_OK;
  fs_context *ctx = p->ctx;
  const fs_space *space = p->space;
  fs_wall *w = NULL;
  int32_t largest = 0;
  int64_t n_samples = 0;
  FS_ALLOC(ctx, w, 1);
  w->problem = p;
  w->target = target;
  w->limit = limit;
  w->stiffness = 1;
  FS_ALLOC(ctx, w->table, space->n_extractions);
  for (int32_t i = 0; i < space->n_extractions; i++) {
    FS_TRY(grid_create(ctx, &space->extraction[i], &w->table[i]));
    if (space->extraction[i].n_dofs > largest) largest = space->extraction[i].n_dofs;
  }
  FS_ALLOC(ctx, w->start, (size_t)space->n_elements + 1);
  for (int32_t e = 0; e < space->n_elements; e++) {
    int32_t n = w->table[space->element[e].extraction].n;
    w->start[e] = n_samples;
    n_samples += n * n;
  }
  w->start[space->n_elements] = n_samples;
  FS_ALLOC(ctx, w->known, n_samples);
  FS_ALLOC(ctx, w->distance, n_samples);
  FS_ALLOC(ctx, w->force, n_samples);
  for (int64_t i = 0; i < n_samples; i++) w->known[i].x = NAN;
  w->n_numbers = 3 * largest + 6 * largest * largest;
  w->n_batch = BATCH_NUMBERS / w->n_numbers;
  if (w->n_batch < 1) w->n_batch = 1;
  if (w->n_batch > MAX_BATCH) w->n_batch = MAX_BATCH;
  FS_ALLOC(ctx, w->value, w->n_batch);
  FS_ALLOC(ctx, w->number, (size_t)w->n_batch * (size_t)w->n_numbers);
  *wall = w;
  w = NULL;
done:
  fs_wall_free(w);
  return status;
}

void fs_wall_free(fs_wall *w) {
  fs_context *ctx;
  if (w == NULL) return;
  ctx = w->problem->ctx;
  for (int32_t i = 0; w->table != NULL && i < w->problem->space->n_extractions; i++) fs_release(ctx, w->table[i].basis);
  fs_release(ctx, w->table);
  fs_release(ctx, w->start);
  fs_release(ctx, w->known);
  fs_release(ctx, w->distance);
  fs_release(ctx, w->force);
  fs_release(ctx, w->value);
  fs_release(ctx, w->number);
  fs_release(ctx, w);
}

/* ---- one element ------------------------------------------------------------------------------------------------- */

typedef struct batch {
  fs_wall *wall;
  fs_order order;
  int32_t first;
} batch;

static bool is_free(const fs_problem *p, const int32_t *dof, int32_t m) {
  for (int32_t k = 0; k < m; k++)
    if (p->unknown[dof[k]] != FS_NONE) return true;
  return false;
}

/* What acts at a sample. */
typedef struct contact {
  double value, force;
  fs_vec3 normal;
  double hessian[6]; /* xx xy xz yy yz zz of W by the sample */
} contact;

/* Second derivatives of the distance along the two directions orthogonal to its gradient, by differences; they vanish along
   it. */
static void add_bending(const fs_wall *w, fs_vec3 at, double distance, contact *c) {
  fs_vec3 t[2], bend[2], nearest, p;
  double step = 1e-4 * w->limit, d;
  fs_tangents(c->normal, t);
  for (int k = 0; k < 2; k++) {
    p = fs_vec3_add_scaled(at, t[k], step);
    d = w->target->distance(w->target->self, p, &nearest);
    if (!(fabs(d - distance) < 0.1 * step)) return; /* another sheet of the target became nearest */
    bend[k] = fs_vec3_scale(fs_vec3_sub(fs_vec3_scale(fs_vec3_sub(p, nearest), 1 / d), c->normal), c->force / step);
  }
  double uu = fs_vec3_dot(t[0], bend[0]), vv = fs_vec3_dot(t[1], bend[1]);
  double uv = 0.5 * (fs_vec3_dot(t[0], bend[1]) + fs_vec3_dot(t[1], bend[0]));
  const double a[3] = {t[0].x, t[0].y, t[0].z}, b[3] = {t[1].x, t[1].y, t[1].z};
  static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int i = 0; i < 6; i++)
    c->hessian[i] += uu * a[row[i]] * a[column[i]] + vv * b[row[i]] * b[column[i]] +
                     uv * (a[row[i]] * b[column[i]] + b[row[i]] * a[column[i]]);
}

/* Whether a force acts on a sample, and which. */
static bool find_contact(fs_wall *w, fs_order order, int64_t sample, fs_vec3 at, contact *c) {
  double begin = w->limit - w->force[sample] / w->stiffness, distance;
  fs_vec3 nearest;
  if (w->distance[sample] + fs_vec3_distance(at, w->known[sample]) <= begin) { /* not with NAN */
    c->force = 0;
    return w->force[sample] > 0;
  }
  distance = w->target->distance(w->target->self, at, &nearest);
  w->known[sample] = at;
  w->distance[sample] = distance;
  c->force = w->stiffness * (distance - begin);
  if (!(c->force > 0) || distance == 0) {
    c->force = 0;
    return w->force[sample] > 0;
  }
  fs_vec3 n = c->normal = fs_vec3_scale(fs_vec3_sub(at, nearest), 1 / distance);
  const double nn[6] = {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
  for (int i = 0; i < 6; i++) c->hessian[i] = w->stiffness * nn[i];
  if (order >= FS_HESSIAN) add_bending(w, at, distance, c);
  return true;
}

/* Adds one sample; h is made for k <= l. */
static void add_sample(fs_order order, int32_t m, const double *N, const contact *c, double *g, double *h) {
  for (int32_t k = 0; k < m && order >= FS_GRADIENT; k++) {
    g[3 * k] += c->force * N[k] * c->normal.x;
    g[3 * k + 1] += c->force * N[k] * c->normal.y;
    g[3 * k + 2] += c->force * N[k] * c->normal.z;
  }
  for (int32_t k = 0; k < m && order >= FS_HESSIAN; k++)
    for (int32_t l = k; l < m; l++)
      for (int a = 0; a < 6; a++) h[6 * ((size_t)k * (size_t)m + (size_t)l) + (size_t)a] += N[k] * N[l] * c->hessian[a];
}

static fs_vec3 sample_point(const fs_problem *p, const int32_t *dof, int32_t m, const double *N) {
  fs_vec3 at = {0, 0, 0};
  for (int32_t d = 0; d < m; d++) at = fs_vec3_add_scaled(at, p->c[dof[d]], N[d]);
  return at;
}

static void run_element(const batch *task, int32_t i) {
  fs_wall *w = task->wall;
  const fs_problem *p = w->problem;
  int32_t number = task->first + i, m;
  const fs_element *e = &p->space->element[number];
  const int32_t *dof = p->space->dof + e->dof_start;
  const fs_grid_table *t = &w->table[e->extraction];
  double *g = w->number + (size_t)i * (size_t)w->n_numbers, *h;
  m = p->space->extraction[e->extraction].n_dofs;
  h = g + 3 * m;
  w->value[i] = 0;
  if (task->order >= FS_GRADIENT) memset(g, 0, 3 * (size_t)m * sizeof *g);
  if (task->order >= FS_HESSIAN) memset(h, 0, 6 * (size_t)m * (size_t)m * sizeof *h);
  if (!is_free(p, dof, m)) return;
  for (int32_t k = 0; k < t->n * t->n; k++) {
    const double *N = t->basis + (size_t)k * (size_t)m;
    int64_t sample = w->start[number] + k;
    contact c = {0};
    if (!find_contact(w, task->order, sample, sample_point(p, dof, m, N), &c)) continue;
    w->value[i] += (c.force * c.force - w->force[sample] * w->force[sample]) / (2 * w->stiffness);
    if (c.force > 0) add_sample(task->order, m, N, &c, g, h);
  }
}

static fs_status run_batch(void *user, int32_t begin, int32_t end, int32_t worker) {
  (void)worker;
  for (int32_t i = begin; i < end; i++) run_element(user, i);
  return FS_OK;
}

/* ---- all elements ------------------------------------------------------------------------------------------------ */

static void scatter(const fs_problem *p, const int32_t *dof, int32_t m, const double *h, fs_sparse *hessian) {
  static const int place[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int32_t k = 0; k < m; k++)
    for (int32_t l = k; l < m; l++) {
      int32_t i = p->unknown[dof[k]], j = p->unknown[dof[l]];
      double block[9];
      if (i == FS_NONE || j == FS_NONE) continue;
      for (int a = 0; a < 9; a++) block[a] = h[6 * ((size_t)k * (size_t)m + (size_t)l) + (size_t)place[a]];
      for (int a = 0; a < 9 && i == j && k != l; a++) block[a] *= 2; /* a dof that occurs twice */
      fs_sparse_add(hessian, i > j ? i : j, i > j ? j : i, block);
    }
}

fs_status fs_wall_add(fs_wall *w, fs_order order, double *f, double *g, fs_sparse *hessian) {
  fs_status status = FS_OK;
  const fs_problem *p = w->problem;
  double sum = 0;
  for (int32_t first = 0; first < p->space->n_elements; first += w->n_batch) {
    batch task = {w, order, first};
    int32_t n = p->space->n_elements - first < w->n_batch ? p->space->n_elements - first : w->n_batch;
    FS_TRY(fs_parallel_for(p->ctx, n, run_batch, &task));
    for (int32_t i = 0; i < n; i++) {
      const fs_element *e = &p->space->element[first + i];
      const int32_t *dof = p->space->dof + e->dof_start;
      const double *number = w->number + (size_t)i * (size_t)w->n_numbers;
      int32_t m = p->space->extraction[e->extraction].n_dofs;
      if (w->value[i] == 0) continue;
      sum += w->value[i];
      for (int32_t k = 0; k < m && order >= FS_GRADIENT; k++)
        for (int a = 0; a < 3 && p->unknown[dof[k]] != FS_NONE; a++)
          g[3 * (size_t)p->unknown[dof[k]] + (size_t)a] += number[3 * k + a];
      if (order >= FS_HESSIAN) scatter(p, dof, m, number + 3 * m, hessian);
    }
  }
  *f += sum;
done:
  return status;
}

typedef struct learning {
  fs_wall *wall;
  double *excess; /* [n_elements] */
} learning;

static fs_status learn_batch(void *user, int32_t begin, int32_t end, int32_t worker) {
  const learning *task = user;
  fs_wall *w = task->wall;
  const fs_problem *p = w->problem;
  (void)worker;
  for (int32_t i = begin; i < end; i++) {
    const fs_element *e = &p->space->element[i];
    const int32_t *dof = p->space->dof + e->dof_start;
    int32_t m = p->space->extraction[e->extraction].n_dofs, n = w->table[e->extraction].n;
    for (int32_t k = 0; k < n * n && is_free(p, dof, m); k++) {
      fs_vec3 at = sample_point(p, dof, m, w->table[e->extraction].basis + (size_t)k * (size_t)m);
      contact c = {0};
      if (!find_contact(w, FS_VALUE, w->start[i] + k, at, &c)) continue;
      w->force[w->start[i] + k] = c.force;
      if (c.force > 0) task->excess[i] = fmax(task->excess[i], w->distance[w->start[i] + k] - w->limit);
    }
  }
  return FS_OK;
}

fs_status fs_wall_learn(fs_wall *w, double *excess) {
  fs_status status = FS_OK;
  const fs_problem *p = w->problem;
  learning task = {.wall = w};
  FS_ALLOC(p->ctx, task.excess, p->space->n_elements);
  FS_TRY(fs_parallel_for(p->ctx, p->space->n_elements, learn_batch, &task));
  *excess = 0;
  for (int32_t i = 0; i < p->space->n_elements; i++) *excess = fmax(*excess, task.excess[i]);
done:
  fs_release(p->ctx, task.excess);
  return status;
}
