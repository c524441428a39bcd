/* SPDX-License-Identifier: MIT */
/* Single role: the triangles of a surface for GLB: single precision, sorted by connected parts, with a place in the ramp of
   colours for the measure. */
#include "glb.h"
#include "floats.h"
#include "measured.h"
#include "base/base.h"

#include <math.h>
#include <string.h>

/* ---- parts: sets of vertices joined by triangles [Tarjan 1975] ---- */

static int32_t find_root(int32_t *parent, int32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

/* part_of[n_vertices], numbered by their first triangles; returns their number. */
static int32_t number_parts(const fs_triangles *t, int32_t *parent, int32_t *part_of) {
  int32_t n = 0;
  for (int32_t v = 0; v < t->n_vertices; v++) parent[v] = v, part_of[v] = FS_NONE;
  for (int32_t i = 0; i < t->n_triangles; i++)
    for (int c = 1; c < 3; c++) {
      const int32_t *corner = t->corner + 3 * (size_t)i;
      parent[find_root(parent, corner[c])] = find_root(parent, corner[0]);
    }
  for (int32_t i = 0; i < t->n_triangles; i++) {
    int32_t root = find_root(parent, t->corner[3 * (size_t)i]);
    if (part_of[root] == FS_NONE) part_of[root] = n++;
  }
  for (int32_t v = 0; v < t->n_vertices; v++) part_of[v] = part_of[find_root(parent, v)];
  return n;
}

/* Where each part begins, and place[n_vertices], the new number of a vertex. corner gets its triangles sorted. */
static void sort_by_parts(const fs_triangles *t, const int32_t *part_of, fs_glb_mesh *mesh, int32_t *place) {
  for (int32_t v = 0; v < t->n_vertices; v++) mesh->part[part_of[v]].n_vertices++;
  for (int32_t i = 0; i < t->n_triangles; i++) mesh->part[part_of[t->corner[3 * (size_t)i]]].n_triangles++;
  for (int32_t p = 1; p < mesh->n_parts; p++) {
    mesh->part[p].first_vertex = mesh->part[p - 1].first_vertex + mesh->part[p - 1].n_vertices;
    mesh->part[p].first_triangle = mesh->part[p - 1].first_triangle + mesh->part[p - 1].n_triangles;
  }
  for (int32_t p = 0; p < mesh->n_parts; p++) mesh->part[p].n_vertices = mesh->part[p].n_triangles = 0;
  for (int32_t v = 0; v < t->n_vertices; v++) {
    fs_glb_part *part = &mesh->part[part_of[v]];
    place[v] = part->first_vertex + part->n_vertices++;
  }
  for (int32_t i = 0; i < t->n_triangles; i++) {
    const int32_t *from = t->corner + 3 * (size_t)i;
    fs_glb_part *part = &mesh->part[part_of[from[0]]];
    int32_t *to = mesh->corner + 3 * ((size_t)part->first_triangle + (size_t)part->n_triangles++);
    for (int c = 0; c < 3; c++) to[c] = place[from[c]] - part->first_vertex;
  }
}

/* ---- numbers ---- */

/* to[place[v]] = from[v] for rows of n numbers. */
static void permute(int32_t n_vertices, int32_t n, const int32_t *place, const float *from, float *to) {
  for (int32_t v = 0; v < n_vertices; v++)
    memcpy(to + (size_t)n * (size_t)place[v], from + (size_t)n * (size_t)v, (size_t)n * sizeof *to);
}

/* The cube on the least corner of the box, in the numbers that the compression sees. */
static void find_grid(fs_glb_mesh *mesh) {
  mesh->grid[3] = 0;
  for (int c = 0; c < 3; c++) {
    float min = mesh->position[c], max = min;
    for (int32_t v = 1; v < mesh->n_vertices; v++) {
      float x = mesh->position[3 * (size_t)v + (size_t)c];
      min = x < min ? x : min;
      max = x > max ? x : max;
    }
    mesh->grid[c] = min;
    if (max - min > mesh->grid[3]) mesh->grid[3] = max - min;
  }
  if (!(mesh->grid[3] > 0)) mesh->grid[3] = 1;
}

/* Places in the ramp, from the middle of its first pixel to that of the last: beyond, pictures repeat. */
static void find_places(fs_glb_mesh *mesh, const double *value, const int32_t *place) {
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    double s = (value[v] - mesh->low) / (mesh->high - mesh->low);
    s = isnan(s) ? 0.5 : fmin(fmax(s, 0), 1);
    mesh->texture[2 * (size_t)place[v]] = (float)((0.5 + s * (FS_GLB_RAMP - 1)) / FS_GLB_RAMP);
    mesh->texture[2 * (size_t)place[v] + 1] = 0.5F;
  }
}

static fs_status add_measure(fs_context *ctx, const fs_model *model, const fs_triangles *t, const int32_t *place,
                             float *row, fs_glb_mesh *mesh) {
  double *value = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, value, t->n_vertices);
  FS_ALLOC(ctx, mesh->measure, t->n_vertices);
  FS_ALLOC(ctx, mesh->texture, 2 * (size_t)t->n_vertices);
  FS_TRY(fs_measure_vertices(ctx, model->surface, model->colour, t, value));
  FS_TRY(fs_measure_range(ctx, value, (size_t)t->n_vertices, &mesh->low, &mesh->high));
  fs_floats_from_values(t->n_vertices, value, row);
  permute(t->n_vertices, 1, place, row, mesh->measure);
  find_places(mesh, value, place);
done:
  fs_release(ctx, value);
  return status;
}

static bool is_closed(const fs_surface *surface) {
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int s = 0; s < surface->patch[p].n_sides; s++)
      if (surface->patch[p].neighbour[s] == FS_NONE) return false;
  return true;
}

fs_status fs_glb_mesh_create(fs_context *ctx, const fs_model *model, int32_t steps, fs_glb_mesh **mesh) {
  fs_glb_mesh *m = NULL;
  fs_triangles *t = NULL;
  int32_t *parent = NULL, *part_of = NULL;
  float *row = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, m, 1);
  FS_TRY(fs_tessellate(ctx, model->surface, steps, &t));
  m->n_vertices = t->n_vertices;
  m->n_triangles = t->n_triangles;
  m->is_closed = is_closed(model->surface);
  FS_ALLOC(ctx, parent, t->n_vertices);
  FS_ALLOC(ctx, part_of, t->n_vertices);
  FS_ALLOC(ctx, row, 3 * (size_t)t->n_vertices);
  FS_ALLOC(ctx, m->position, 3 * (size_t)t->n_vertices);
  FS_ALLOC(ctx, m->normal, 3 * (size_t)t->n_vertices);
  FS_ALLOC(ctx, m->corner, 3 * (size_t)t->n_triangles);
  m->n_parts = number_parts(t, parent, part_of);
  FS_ALLOC(ctx, m->part, m->n_parts);
  int32_t *place = parent; /* no longer needed */
  sort_by_parts(t, part_of, m, place);
  FS_TRY(fs_floats_from_vectors(ctx, t->n_vertices, t->position, row));
  permute(t->n_vertices, 3, place, row, m->position);
  FS_TRY(fs_floats_from_vectors(ctx, t->n_vertices, t->normal, row));
  permute(t->n_vertices, 3, place, row, m->normal);
  if (model->colour != NULL) FS_TRY(add_measure(ctx, model, t, place, row, m));
  find_grid(m);
  *mesh = m;
  m = NULL;
done:
  fs_release(ctx, parent);
  fs_release(ctx, part_of);
  fs_release(ctx, row);
  fs_triangles_free(ctx, t);
  fs_glb_mesh_free(ctx, m);
  return status;
}

void fs_glb_mesh_free(fs_context *ctx, fs_glb_mesh *mesh) {
  if (mesh == NULL) return;
  fs_release(ctx, mesh->part);
  fs_release(ctx, mesh->position);
  fs_release(ctx, mesh->normal);
  fs_release(ctx, mesh->measure);
  fs_release(ctx, mesh->texture);
  fs_release(ctx, mesh->corner);
  fs_release(ctx, mesh);
}
