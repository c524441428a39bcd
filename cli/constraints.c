/* SPDX-License-Identifier: MIT */
/* Single role: from the options of constraints to constraints on the net that is faired. */
#include "constraints.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TRY(call)                         \
  do {                                    \
    fs_status status_ = (call);           \
    if (status_ != FS_OK) return status_; \
  } while (0)

static double dot(const double *a, fs_vec3 p) { return a[0] * p.x + a[1] * p.y + a[2] * p.z; }

static double diagonal(const fs_mesh *mesh) {
  fs_vec3 low = mesh->position[0], high = low;
  for (int32_t v = 1; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v];
    low = (fs_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
    high = (fs_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
  }
  return hypot(hypot(high.x - low.x, high.y - low.y), high.z - low.z);
}

static bool is_in(const region *r, fs_vec3 p, double tolerance) {
  const double *n = r->number, at[3] = {p.x, p.y, p.z};
  if (!r->is_box) return fabs(dot(n, p) - n[3]) <= tolerance * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int k = 0; k < 3; k++)
    if (at[k] < fmin(n[k], n[3 + k]) - tolerance || at[k] > fmax(n[k], n[3 + k]) + tolerance) return false;
  return true;
}

static fs_status fix_regions(fs_context *ctx, const constraint_arguments *a, const fs_mesh *mesh, bool *fixed) {
  double tolerance = 1e-9 * diagonal(mesh);
  for (int32_t i = 0; i < a->n_regions; i++) {
    int32_t n = 0;
    for (int32_t v = 0; v < mesh->n_vertices; v++)
      if (is_in(&a->region[i], mesh->position[v], tolerance)) fixed[v] = true, n++;
    if (n > 0) continue;
    const double *x = a->region[i].number;
    if (a->region[i].is_box)
      snprintf(ctx->message, sizeof ctx->message, "--fix-box %g,%g,%g,%g,%g,%g: no vertex of the net is in it", x[0],
               x[1], x[2], x[3], x[4], x[5]);
    else
      snprintf(ctx->message, sizeof ctx->message, "--fix-plane %g,%g,%g,%g: no vertex of the net is on it", x[0], x[1],
               x[2], x[3]);
    return FS_ERR_ARGUMENT;
  }
  return FS_OK;
}

static fs_status make_start(fs_context *ctx, const fs_space *space, const fs_vec3 *c, constraint_set *set) {
  TRY(fs_surface_create(ctx, space, c, &set->start));
  return fs_nearest_create(ctx, set->start, &set->nearest);
}

static fs_status make_target(fs_context *ctx, const constraint_arguments *a, constraint_set *set) {
  set->target = (fs_target){fs_nearest_distance, set->nearest};
  if (a->stay_near != NULL) {
    fs_mesh *mesh = NULL;
    fs_status status;
    TRY(fs_mesh_read(ctx, a->stay_near, &mesh));
    status = fs_nearest_create_for_mesh(ctx, mesh, &set->near_mesh);
    fs_mesh_free(ctx, mesh);
    if (status != FS_OK) return status;
    set->target.self = set->near_mesh;
  }
  set->constraints.tolerance = a->stay_within;
  set->constraints.target = &set->target;
  return FS_OK;
}

fs_status make_constraints(fs_context *ctx, const constraint_arguments *a, const fs_mesh *mesh, const fs_space *space,
                           const fs_vec3 *c, bool is_refined, bool *fixed, constraint_set *set) {
  const fs_vec3 normal = {a->plane[0], a->plane[1], a->plane[2]};
  TRY(fix_regions(ctx, a, mesh, fixed));
  if (a->points != NULL || a->stay_within > 0) TRY(make_start(ctx, space, c, set));
  if (a->points != NULL) TRY(read_points(ctx, a->points, space, is_refined, set));
  if (a->equations != NULL) TRY(read_equations(ctx, a->equations, space, is_refined, set));
  if (a->stay_within > 0) TRY(make_target(ctx, a, set));
  if (a->is_symmetric) {
    TRY(fs_symmetry_create(ctx, mesh, space, a->is_plane_given ? &normal : NULL, a->plane[3], &set->symmetry));
    set->constraints.symmetry = set->symmetry;
    if (!a->is_plane_given && ctx->note != NULL) {
      char text[160];
      snprintf(text, sizeof text, "symmetric about the plane %.6g x + %.6g y + %.6g z = %.6g", set->symmetry->normal.x,
               set->symmetry->normal.y, set->symmetry->normal.z, set->symmetry->offset);
      ctx->note(ctx->user, text);
    }
  }
  set->constraints.keep = a->keep;
  return FS_OK;
}

void free_constraints(fs_context *ctx, constraint_set *set) {
  fs_nearest_free(ctx, set->nearest);
  fs_nearest_free(ctx, set->near_mesh);
  fs_surface_free(ctx, set->start);
  fs_symmetry_free(ctx, set->symmetry);
  free(set->hold);
  free(set->equation);
  free(set->dof);
  free(set->weight);
  free(set->names);
}
