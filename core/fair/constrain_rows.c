/* SPDX-License-Identifier: MIT */
/* Single role: holds and equations become equations in z, one after the other.

     place        sum of w_d c_d = position                    w_d: value of the function of dof d at (u, v)
     tangent      n . sum of w_d c_d = 0  for w of p_u and of p_v
     equation     sum of weight_d c_d = value, or its product with a direction */
#include "fair/constrain.h"
#include "math/bernstein.h"
#include "math/vec3.h"

#include <stdio.h>

enum { MAX_DOFS = 1024, MAX_DEGREE = 31, NAME = 96 };

void fs_constrain_weights(const fs_extraction *x, double u, double v, int32_t order_u, int32_t order_v,
                          double *weight) {
  double by_u[MAX_DEGREE + 1], by_v[MAX_DEGREE + 1];
  fs_bernstein_basis(x->degree_u, u, order_u, by_u);
  fs_bernstein_basis(x->degree_v, v, order_v, by_v);
  for (int32_t d = 0; d < x->n_dofs; d++) weight[d] = 0;
  for (int32_t j = 0; j <= x->degree_v; j++)
    for (int32_t i = 0; i <= x->degree_u; i++) {
      const double *row = x->E + (size_t)(i + (x->degree_u + 1) * j) * (size_t)x->n_dofs;
      for (int32_t d = 0; d < x->n_dofs; d++) weight[d] += by_u[i] * by_v[j] * row[d];
    }
}

/* What all equations share. */
typedef struct rows {
  fs_context *ctx;
  const fs_base *base;
  fs_elimination *elimination;
  char name[NAME]; /* of the constraint that is being added, for messages */
  int32_t n_new, n_rows;
} rows;

/* One more equation: sum over dofs of weight * (direction . c) = value. */
static fs_status add_row(rows *r, int32_t n, const int32_t *dof, const double *weight, fs_vec3 direction,
                         double value) {
  fs_status status = FS_OK;
  const fs_reduction *map = r->base->map;
  const double along[3] = {direction.x, direction.y, direction.z};
  fs_elimination_result result;
  double residual, largest = 0;
  for (int32_t k = 0; k < n; k++) {
    largest = fmax(largest, fabs(weight[k]));
    const double *x0 = map->x0 + 3 * (size_t)dof[k];
    value -= weight[k] * (along[0] * x0[0] + along[1] * x0[1] + along[2] * x0[2]);
    for (int32_t e = map->row_start[dof[k]]; e < map->row_start[dof[k] + 1]; e++)
      for (int b = 0; b < 3; b++) {
        const double *block = map->block + 9 * (size_t)e + b;
        double coefficient = weight[k] * (along[0] * block[0] + along[1] * block[3] + along[2] * block[6]);
        if (coefficient != 0) fs_elimination_add(r->elimination, 3 * map->column[e] + b, coefficient);
      }
  }
  FS_TRY(fs_elimination_finish(r->ctx, r->elimination, value, largest * r->base->size, &result, &residual));
  r->n_rows++;
  r->n_new += result == FS_EQUATION_NEW;
  if (result == FS_EQUATION_CONTRADICTS)
    status =
        fs_fail(r->ctx, FS_ERR_ARGUMENT,
                "%s contradicts what is fixed, the symmetry or the constraints before it, by %.3g", r->name, residual);
done:
  return status;
}

static fs_status add_point(rows *r, int32_t n, const int32_t *dof, const double *weight, fs_vec3 value) {
  fs_status status = FS_OK;
  FS_TRY(add_row(r, n, dof, weight, (fs_vec3){1, 0, 0}, value.x));
  FS_TRY(add_row(r, n, dof, weight, (fs_vec3){0, 1, 0}, value.y));
  FS_TRY(add_row(r, n, dof, weight, (fs_vec3){0, 0, 1}, value.z));
done:
  return status;
}

static void begin(rows *r, const char *kind, const char *name, int32_t number) {
  if (name != NULL)
    snprintf(r->name, sizeof r->name, "%s", name);
  else
    snprintf(r->name, sizeof r->name, "%s %d", kind, number);
  r->n_new = r->n_rows = 0;
}

static void end(rows *r) {
  if (r->n_new == 0 && r->n_rows > 0)
    fs_note(r->ctx, "%s follows from what is fixed, the symmetry or the constraints before it", r->name);
}

static fs_status check_hold(fs_context *ctx, const fs_space *space, const fs_hold *h, const char *name) {
  if (h->element < 0 || h->element >= space->n_elements)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s is on element %d: 0 to %d are possible", name, h->element,
                   space->n_elements - 1);
  if (!(h->u >= 0 && h->u <= 1 && h->v >= 0 && h->v <= 1))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s is at (%g, %g) of its element: 0 to 1 are possible", name, h->u, h->v);
  if (h->has_position && !fs_vec3_is_finite(h->position))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s has a place that is not finite", name);
  if (h->has_normal && (!fs_vec3_is_finite(h->normal) || !(fs_vec3_length(h->normal) > 0)))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s has the normal (%g, %g, %g), which is no direction", name, h->normal.x,
                   h->normal.y, h->normal.z);
  return FS_OK;
}

/* A point on the plane of symmetry stays on it, and its normal lies in it: numbers that say so to 1e-6 become exact. */
static void snap_to_plane(const rows *r, const fs_symmetry *s, int32_t n, const int32_t *dof, const double *weight,
                          fs_hold *h) {
  double tolerance = 1e-6 * r->base->size, along = fs_vec3_dot(s->normal, h->normal);
  fs_vec3 at = {0, 0, 0};
  for (int32_t k = 0; k < n; k++) at = fs_vec3_add_scaled(at, r->base->c[dof[k]], weight[k]);
  if (fabs(fs_vec3_dot(s->normal, at) - s->offset) > tolerance) return;
  if (fabs(along) <= 1e-6 * fs_vec3_length(h->normal)) h->normal = fs_vec3_add_scaled(h->normal, s->normal, -along);
  along = fs_vec3_dot(s->normal, h->position) - s->offset;
  if (fabs(along) <= tolerance) h->position = fs_vec3_add_scaled(h->position, s->normal, -along);
}

static fs_status add_hold(rows *r, const fs_space *space, const fs_symmetry *symmetry, const fs_hold *given) {
  fs_status status = FS_OK;
  double weight[MAX_DOFS];
  fs_hold own = *given, *h = &own;
  FS_TRY(check_hold(r->ctx, space, h, r->name));
  const fs_element *e = &space->element[h->element];
  const fs_extraction *x = &space->extraction[e->extraction];
  const int32_t *dof = space->dof + e->dof_start;
  if (x->n_dofs > MAX_DOFS || x->degree_u > MAX_DEGREE || x->degree_v > MAX_DEGREE)
    return fs_fail(r->ctx, FS_ERR_UNSUPPORTED, "%s is on element %d, which has %d dofs", r->name, h->element,
                   x->n_dofs);
  fs_constrain_weights(x, h->u, h->v, 0, 0, weight);
  if (symmetry != NULL) snap_to_plane(r, symmetry, x->n_dofs, dof, weight, h);
  if (h->has_position) {
    FS_TRY(add_point(r, x->n_dofs, dof, weight, h->position));
  }
  for (int axis = 0; axis < 2 && h->has_normal; axis++) {
    fs_vec3 normal = fs_vec3_scale(h->normal, 1 / fs_vec3_length(h->normal));
    fs_constrain_weights(x, h->u, h->v, 1 - axis, axis, weight);
    FS_TRY(add_row(r, x->n_dofs, dof, weight, normal, 0));
  }
done:
  return status;
}

static fs_status add_equation(rows *r, const fs_space *space, const fs_equation *q) {
  double length = fs_vec3_length(q->direction);
  for (int32_t k = 0; k < q->n_terms; k++) {
    if (q->dof[k] < 0 || q->dof[k] >= space->n_dofs)
      return fs_fail(r->ctx, FS_ERR_ARGUMENT, "%s names vertex %d: 0 to %d are there", r->name, q->dof[k],
                     space->n_dofs - 1);
    if (!isfinite(q->weight[k]))
      return fs_fail(r->ctx, FS_ERR_ARGUMENT, "%s has a weight that is not finite at vertex %d", r->name, q->dof[k]);
  }
  if (!fs_vec3_is_finite(q->value) || !isfinite(length))
    return fs_fail(r->ctx, FS_ERR_ARGUMENT, "%s has a value or a direction that is not finite", r->name);
  if (length > 0)
    return add_row(r, q->n_terms, q->dof, q->weight, fs_vec3_scale(q->direction, 1 / length), q->value.x / length);
  return add_point(r, q->n_terms, q->dof, q->weight, q->value);
}

fs_status fs_constrain_solve(fs_context *ctx, const fs_space *space, const fs_constraints *constraints,
                             const fs_base *base, fs_elimination *elimination) {
  fs_status status = FS_OK;
  rows r = {.ctx = ctx, .base = base, .elimination = elimination};
  for (int32_t i = 0; i < constraints->n_holds; i++) {
    begin(&r, "hold", constraints->hold[i].name, i);
    FS_TRY(add_hold(&r, space, constraints->symmetry, &constraints->hold[i]));
    end(&r);
  }
  for (int32_t i = 0; i < constraints->n_equations; i++) {
    begin(&r, "equation", constraints->equation[i].name, i);
    FS_TRY(add_equation(&r, space, &constraints->equation[i]));
    end(&r);
  }
done:
  return status;
}
