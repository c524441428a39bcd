/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: from a layer to a space, from a surface to a mesh that is as fine as a tolerance asks. */
#include "build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

fs_status layer_to_mesh(fs_context *ctx, const layer *l, fs_mesh **mesh) {
  const polygon_list *p = &l->polygons;
  return fs_mesh_create(ctx, p->n_vertices, p->position, p->n_faces, p->face_start, p->corner, mesh);
}

fs_status prepared_create(fs_context *ctx, const layer *l, int32_t at_least, fs_cap_inner caps, prepared *p) {
  fs_status status = FS_OK;
  fs_space_options options = {.caps = caps};
  TRY(layer_to_mesh(ctx, l, &p->mesh));
  TRY(fs_space_prepare(ctx, p->mesh, at_least, p->step, &p->n_steps));
  p->fine = p->n_steps > 0 ? p->step[p->n_steps - 1]->mesh : p->mesh;
  TRY(fs_space_create_with(ctx, p->fine, &options, &p->space));
done:
  return status;
}

void prepared_clear(fs_context *ctx, prepared *p) {
  fs_space_free(ctx, p->space);
  for (int32_t s = 0; s < p->n_steps; s++) fs_refinement_free(ctx, p->step[s]);
  fs_mesh_free(ctx, p->mesh);
  *p = (prepared){0};
}

/* ---- the density of a mesh ---------------------------------------------------------------------------------------- */

enum { N_SAMPLES = 6, MAX_STEPS = 64, MAX_RESULT_FACES = 4000000 };

static double length(fs_vec3 a) { return sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

/* A triangle over a cell of side h deviates from the surface by at most h^2 / 8 (|p_uu| + 2 |p_uv| + |p_vv|) (Taylor's
   theorem for linear interpolation): the largest bracket of a patch, from samples. *low, *high: box of the samples. */
static double patch_bend(const fs_surface *surface, int32_t patch, fs_vec3 *low, fs_vec3 *high) {
  double bend = 0;
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t j = 0; j < N_SAMPLES; j++)
    for (int32_t i = 0; i < N_SAMPLES; i++) {
      double u = (double)i / (N_SAMPLES - 1), v = (double)j / (N_SAMPLES - 1), b;
      if (!fs_domain_holds(surface->patch[patch].n_sides, u, v)) continue;
      fs_surface_evaluate(surface, patch, u, v, x);
      b = length(x[FS_DUU]) + 2 * length(x[FS_DUV]) + length(x[FS_DVV]);
      if (b > bend) bend = b;
      low->x = fmin(low->x, x[FS_D].x), high->x = fmax(high->x, x[FS_D].x);
      low->y = fmin(low->y, x[FS_D].y), high->y = fmax(high->y, x[FS_D].y);
      low->z = fmin(low->z, x[FS_D].z), high->z = fmax(high->z, x[FS_D].z);
    }
  return bend;
}

static fs_status choose_steps(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t *n_steps) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  double bend = 0, n, diagonal;
  for (int32_t i = 0; i < surface->n_patches; i++) bend = fmax(bend, patch_bend(surface, i, &low, &high));
  diagonal = length((fs_vec3){high.x - low.x, high.y - low.y, high.z - low.z});
  n = ceil(sqrt(bend / (8 * 0.01 * tolerance * diagonal)));
  n = fmin(fmax(n, 1), MAX_STEPS);
  if (n * n * surface->n_patches > MAX_RESULT_FACES)
    return refuse(
        ctx, FS_ERR_UNSUPPORTED,
        "within this tolerance the mesh would have %.0f faces, and MeshLab takes some %d: choose a larger one",
        n * n * surface->n_patches, MAX_RESULT_FACES);
  *n_steps = (int32_t)n;
  return FS_OK;
}

/* ---- the mesh -------------------------------------------------------------------------------------------------------- */

/* Two triangles with a common edge as a quadrilateral that keeps their sense; false where they have none. */
static bool join_pair(const int32_t a[3], const int32_t b[3], int32_t quad[4]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j]) {
        quad[0] = a[(i + 2) % 3], quad[1] = a[i], quad[2] = b[(j + 2) % 3], quad[3] = a[(i + 1) % 3];
        return quad[0] != quad[2];
      }
  return false;
}

static fs_status take_cells(fs_context *ctx, const fs_surface *surface, const fs_triangles *t, polygon_list *p) {
  fs_status status = FS_OK;
  p->n_vertices = t->n_vertices;
  TAKE(ctx, p->position, t->n_vertices);
  memcpy(p->position, t->position, (size_t)t->n_vertices * sizeof *p->position);
  TAKE(ctx, p->face_start, (size_t)t->n_triangles + 1);
  TAKE(ctx, p->corner, 3 * (size_t)t->n_triangles);
  for (int32_t i = 0; i < t->n_triangles; i++) {
    const int32_t *c = t->corner + 3 * (size_t)i;
    int32_t start = p->face_start[p->n_faces];
    bool is_cell = surface->patch[t->patch[i]].n_sides == 4 && i + 1 < t->n_triangles &&
                   t->patch[i + 1] == t->patch[i] && join_pair(c, c + 3, p->corner + start);
    if (!is_cell) memcpy(p->corner + start, c, 3 * sizeof *c);
    p->face_start[++p->n_faces] = start + (is_cell ? 4 : 3);
    i += is_cell;
  }
done:
  return status;
}

static fs_status measure_vertices(fs_context *ctx, const fs_surface *surface, const fs_triangles *t,
                                  const fs_measure *measure, outcome *o) {
  fs_status status = FS_OK;
  double param[16] = {0}, *value = NULL;
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t k = 0; measure->params != NULL && measure->params[k].name != NULL && k < 16; k++)
    param[k] = measure->params[k].initial;
  TAKE(ctx, value, t->n_vertices);
  for (int32_t v = 0; v < t->n_vertices; v++) {
    const double *uv = t->vertex_uv + 2 * (size_t)v;
    fs_surface_evaluate(surface, t->vertex_patch[v], uv[0], uv[1], x);
    value[v] = measure->value(param, x);
  }
  return outcome_take_quality(ctx, value, t->n_vertices, o);
done:
  return status;
}

fs_status outcome_take_surface(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t colour,
                               outcome *o) {
  fs_status status = FS_OK;
  fs_triangles *t = NULL;
  int32_t n_steps;
  TRY(choose_steps(ctx, surface, tolerance, &n_steps));
  TRY(fs_tessellate(ctx, surface, n_steps, &t));
  TRY(take_cells(ctx, surface, t, &o->polygons));
  TAKE(ctx, o->normal, t->n_vertices);
  memcpy(o->normal, t->normal, (size_t)t->n_vertices * sizeof *o->normal);
  if (colour > 0) TRY(measure_vertices(ctx, surface, t, fs_measures[colour - 1], o));
  outcome_say(o, "%d patches, each cut into %d x %d cells: %d vertices, %d faces\n", surface->n_patches, n_steps,
              n_steps, o->polygons.n_vertices, o->polygons.n_faces);
  outcome_add(o, "steps", n_steps);
done:
  fs_triangles_free(ctx, t);
  return status;
}

/* ---- quality --------------------------------------------------------------------------------------------------------- */

static int compare_numbers(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

fs_status outcome_take_quality(fs_context *ctx, double *value, int32_t n, outcome *o) {
  fs_status status = FS_OK;
  double *sorted = NULL, least;
  int32_t n_finite = 0;
  o->quality = value;
  TAKE(ctx, sorted, n);
  for (int32_t i = 0; i < n; i++)
    if (isfinite(value[i])) sorted[n_finite++] = value[i];
  o->low = 0, o->high = 1;
  if (n_finite > 0) {
    qsort(sorted, (size_t)n_finite, sizeof *sorted, compare_numbers);
    o->low = sorted[(n_finite - 1) / 50];
    o->high = sorted[n_finite - 1 - (n_finite - 1) / 50];
    /* a constant, but for the single precision of MeshLab, is shown in the colour of the middle */
    least = 1e-6 * fmax(fabs(o->low), fabs(o->high)) + 1e-30;
    if (o->high - o->low < least) o->low -= least, o->high += least;
  }
  for (int32_t i = 0; i < n; i++)
    if (!isfinite(value[i])) value[i] = 0.5 * (o->low + o->high);
done:
  free(sorted);
  return status;
}
